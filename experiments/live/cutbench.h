/* cutbench for other people's programs: sheets that move and are cut, in memory. docs/reference/browser.md explains it.
 *
 * A sheet is a number above 0. Lengths are metres, "rest" is the flat sheet before it moved. Functions that return text
 * return JSON, which is valid until the next call; what went wrong is {"error": "..."}, and nothing has changed then.
 * Not for several threads at a time. */
#ifndef CUTBENCH_H
#define CUTBENCH_H

#ifdef __cplusplus
extern "C" {
#endif

/* {"sheet": number}. `scene`: {} is a hanging square of 3,200 triangles; see docs/reference/browser.md for its keys. */
const char* cutbench_make(const char* scene);
void cutbench_free(int sheet);

/* Makes at most so many steps, each of the scene's length; {"steps": made}, or its error where the simulation broke. */
const char* cutbench_step(int sheet, int steps);

/* Where the ray from x, y, z along dx, dy, dz first meets the sheet: {"rest": [x, y]}. */
const char* cutbench_pick(int sheet, double x, double y, double z, double dx, double dy, double dz);

/* Cuts. `method`: one of cutbench_methods(), the same for all cuts of a sheet where one makes polygons, constraints or
 * copies; `parameter`: its number, NaN for the usual one; `path`: the text of a path
 * file, in rest space: {"cuts": [{"bezier": [[x, y], ...]}]}. Says what came of it, and cutbench_numbers(). */
const char* cutbench_cut(int sheet, const char* method, double parameter, const char* path);
/* Back to right before the last cut, four times at most: {"undone": true or false}. */
const char* cutbench_undo(int sheet);

/* What lies within `radius` of a place at rest is drawn towards x, y, z from now on, or is let go (release). */
const char* cutbench_grab(int sheet, double rest_x, double rest_y, double radius);
void cutbench_drag(int sheet, double x, double y, double z);
void cutbench_release(int sheet);
/* A push of vx, vy, vz m/s. */
const char* cutbench_poke(int sheet, double rest_x, double rest_y, double radius, double vx, double vy, double vz);

/* {"triangles", "triangles_before", "vertices", "aspect_ratio", "pieces", "polygons", "time"} */
const char* cutbench_numbers(int sheet);
/* The sheet as it is now, an OBJ: `v` in space, `vt` at rest. Text, not JSON. */
const char* cutbench_obj(int sheet);
/* Where places at rest are now: `count` pairs are read from `rest`, as many triples written to `space`. */
const char* cutbench_places(int sheet, int count, const double* rest, double* space);

/* Arrays of the opened sheet, valid until the next call for this sheet. *count: of vertices, triangles or, of
 * cutbench_draw(), triangles with 15 numbers each (live_sheet.h). Vertices of both lips of a cut are different ones. */
const double* cutbench_positions(int sheet, int* count);
const double* cutbench_rest(int sheet, int* count);
const int* cutbench_triangles(int sheet, int* count);
const float* cutbench_draw(int sheet, int colour, int at_rest, int* count);

/* Without a simulation, in the sheet of `scene` at rest: the oracle's verdict on the cuts, made one after the other;
 * and the time of the last one, repeated on warm copies. */
const char* cutbench_judge(const char* scene, const char* method, double parameter, const char* path);
const char* cutbench_time(const char* scene, const char* method, double parameter, const char* path);

/* [{"name", "summary", "parameter": {"name", "value", "meaning"}}] */
const char* cutbench_methods(void);

#ifdef __cplusplus
}
#endif
#endif
