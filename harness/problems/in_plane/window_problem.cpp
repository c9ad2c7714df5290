#include "harness/problems/in_plane/window_problem.h"

#include <numbers>
#include <utility>

#include "harness/mesh/families.h"
#include "harness/problems/common/members.h"
#include "harness/problems/in_plane/mouth.h"
#include "harness/problems/in_plane/window_comparison.h"

namespace cutbench {

namespace {

/// The same frame for a member of every size: only its distance from the mesh's cells is in units of them.
Axes member_frame(const WindowCase& window, int n, std::uint64_t seed, std::size_t index) {
  MemberNumbers numbers(seed, index);
  Axes frame;
  Point2 place{0.5 + numbers.between(-0.5, 0.5) / n, 0.5 + numbers.between(-0.5, 0.5) / n};
  if (index % 2 == 0) {
    const int row = n / 2;
    place.y = (row + distance_from_mesh_line(numbers)) / n;
  } else {
    const double turn = window.largest_turn;
    frame.angle = turn < std::numbers::pi ? numbers.between(-turn, turn) : numbers.between(0, 2 * std::numbers::pi);
  }
  frame.origin = place - (Axes{{0, 0}, frame.angle}).to_rest({window.middle.x, window.middle.y});
  return frame;
}

class WindowProblem final : public Problem {
 public:
  explicit WindowProblem(WindowCase window) : window_(std::move(window)) {}
  std::string name() const override { return window_.name; }
  std::string effect() const override { return window_.effect; }
  std::string truth() const override { return window_.truth; }
  std::vector<std::string> measures() const override { return window_.measures; }

  Specimen specimen(const std::string& family, int n, std::uint64_t seed, std::size_t index) const override {
    const Axes frame = member_frame(window_, n, seed, index);
    Specimen specimen{make_sheet(family, n), window_.cuts, frame.origin, frame.angle};
    for (Curve& cut : specimen.cuts)
      for (Point2& p : cut.points) p = frame.to_rest({p.x, p.y});
    return specimen;
  }

  std::vector<Answer> answer(const Specimen& specimen, const Sheet& sheet, std::span<const Budget> budgets,
                             const Constraints& constraints) const override {
    const ElasticField field = window_.field({specimen.origin, specimen.angle});
    StaticSolve solve(sheet, sheet_material, constraints);
    if (window_.mouth)
      solve.hold_border(continued_over_the_mouth(field, sheet));
    else
      solve.hold_border([&](Point2 p, Point2 inside) { return field.displacement(p, inside); });
    const auto& cut_off = window_.cut_off;
    if (cut_off)
      solve.hold_loose_pieces([&](Point2 p) { return cut_off(field.frame().to_local(p)); });
    else
      solve.hold_loose_pieces();
    if (window_.on_lips) solve.load_lips(field.frame(), window_.on_lips);
    solve.make_tip_functions(budgets);
    const WindowComparison comparison(window_, specimen, sheet, solve, field);
    std::vector<Answer> answers;
    for (const Budget& budget : budgets) {
      StaticSolve::Solution solution = solve.solve(budget);
      if (!solution.answer.refused && solution.answer.verdict != Verdict::not_finite)
        solution.answer.measures = comparison.measures(solution);
      answers.push_back(std::move(solution.answer));
    }
    return answers;
  }

 private:
  WindowCase window_;
};

}  // namespace

void append_window_problems(std::vector<std::unique_ptr<const Problem>>& problems) {
  for (const auto& cases : {first_cases(), crack_cases(), cut_out_cases()})
    for (const WindowCase& window : cases) problems.push_back(make_window_problem(window));
}

std::unique_ptr<const Problem> make_window_problem(WindowCase window) {
  return std::make_unique<WindowProblem>(std::move(window));
}

}  // namespace cutbench
