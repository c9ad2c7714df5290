"""Cuts in a loop leave the memory where it was. CUTBENCH_MANY=50 makes 100,000 of them."""

import gc
import unittest

from command_line import MANY

import cutbench


def resident_mb():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * 4096 / 1e6


def idle(sheet, path):
    return sheet.cut(path, "example")


class Memory(unittest.TestCase):
    def stays(self, work, rounds, allowed_mb=8):
        for _ in range(rounds // 10):
            work()
        gc.collect()
        before = resident_mb()
        for _ in range(rounds):
            work()
        gc.collect()
        grown = resident_mb() - before
        print(f"{rounds} times: {grown:+.2f} MB", end="; ")
        self.assertLess(grown, allowed_mb)

    def test_cuts(self):
        sheet = cutbench.Sheet.family("grid", 200)
        arrays = sheet.vertices.copy(), sheet.triangles.copy()

        def work():
            made = cutbench.cut(*arrays, [[-0.1, 0.3], [0.6, 0.55]])
            made.vertices, made.triangles, made.rest

        self.stays(work, 2000 * MANY)

    def test_all_of_a_cut(self):
        sheet = cutbench.Sheet.family("grid", 50)

        def work():
            made = sheet.cut([[-0.1, 0.3], [0.6, 0.55]], "cut_polygons")
            made.parents, made.constraints, made.quality, made.incision, made.pieces

        self.stays(work, 300 * min(MANY, 10))

    def test_functions_and_errors(self):
        sheet = cutbench.Sheet.family("grid", 50)

        def work():
            sheet.cut([[-0.1, 0.3], [0.6, 0.55]], idle)
            try:
                sheet.cut([[5, 5], [6, 6]])
            except cutbench.InputError:
                pass

        self.stays(work, 300 * min(MANY, 10))

    def test_simulations(self):
        scene = cutbench.Scene(sheet=cutbench.Sheet.family("grid", 50))

        def work():
            simulation = cutbench.Simulation(scene)
            simulation.step(2)
            simulation.cut([[-0.1, 0.3], [0.6, 0.55]])
            simulation.x, simulation.times

        self.stays(work, 100 * min(MANY, 10))


if __name__ == "__main__":
    unittest.main()
