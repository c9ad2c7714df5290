#include "harness/scene/energy_budget.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include "harness/base/whole_file.h"

namespace cutbench {

EnergyBudget::EnergyBudget(const Balance& first) { rows_.push_back({.energy = first.energy}); }

template <int D>
void EnergyBudget::add_step(Model<D>& model, const State& before, const State& after, double step) {
  const double alpha = model.material().mass_damping, beta = model.material().stiffness_damping;
  const Field &v = after.v, dv = after.v - before.v;
  const auto times_mass = [&](const Field& x) {
    Field y = Field::Zero(x.size());
    model.add_mass_product(1, x, y);
    return y;
  };
  const Field mass_v = times_mass(v), mass_dv = times_mass(dv);
  // K v from A v, A = (1 + h alpha) M + (h beta + h^2) K
  Field stiffness_v = Field::Zero(v.size());
  model.system().add_product(v, stiffness_v);
  stiffness_v -= (1 + step * alpha) * mass_v;
  stiffness_v /= step * beta + step * step;

  BudgetRow row = rows_.back();
  row.time = after.time;
  row.damping += step * (alpha * v.dot(mass_v) + beta * v.dot(stiffness_v));
  row.numerical_loss += (dv.dot(mass_dv) + step * step * v.dot(stiffness_v)) / 2;

  model.rotate(after.x);
  Field force = Field::Zero(v.size());  // of all but the pins, at the end of the step
  model.add_internal_force(after.x, force);
  model.add_external_force(force);
  Field pin_force = mass_dv / step + alpha * mass_v + beta * stiffness_v - force;
  if (model.tied()) model.tied()->transfer_forces(model.held(), pin_force);
  for (std::size_t i = 0; i < model.held().size(); ++i)
    if (model.pinned(i))
      row.pin_work += step * v[static_cast<Eigen::Index>(i)] * pin_force[static_cast<Eigen::Index>(i)];

  row.energy = model.energy(after.x, v);
  const double change = row.energy.total() - rows_.front().energy.total();
  row.remainder = change - row.jumps - row.pin_work + row.damping + row.numerical_loss;
  rows_.push_back(row);
}

void EnergyBudget::add_cut(const Balance& before, const Balance& after) {
  rows_.back().jumps += after.energy.total() - before.energy.total();
  rows_.back().energy = after.energy;
}

double EnergyBudget::growth() const {
  double lowest = 0, rise = 0, scale = 0;
  const double start = rows_.front().energy.total();
  for (const BudgetRow& row : rows_) {
    const double less_work = row.energy.total() - start - row.pin_work - row.jumps;
    lowest = std::min(lowest, less_work);
    rise = std::max(rise, less_work - lowest);
    scale = std::max(scale, row.energy.kinetic + row.energy.membrane + row.energy.bending);
  }
  return scale > 0 ? rise / scale : 0;
}

void EnergyBudget::write(const std::filesystem::path& file) const {
  std::string text =
      "time_s,membrane_j,bending_j,kinetic_j,potential_j,pin_work_j,damping_j,numerical_loss_j,jumps_j,remainder_j\n";
  for (const BudgetRow& r : rows_) {
    char line[256];
    std::snprintf(line, sizeof line, "%.10g,%.10g,%.10g,%.10g,%.10g,%.10g,%.10g,%.10g,%.10g,%.10g\n", r.time,
                  r.energy.membrane, r.energy.bending, r.energy.kinetic, r.energy.potential, r.pin_work, r.damping,
                  r.numerical_loss, r.jumps, r.remainder);
    text += line;
  }
  WholeFile(file, text).place();
}

template void EnergyBudget::add_step(Model<2>&, const State&, const State&, double);
template void EnergyBudget::add_step(Model<3>&, const State&, const State&, double);

}  // namespace cutbench
