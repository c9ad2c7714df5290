#include "harness/simulation/energy_budget.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "harness/base/conversions.h"
#include "harness/fem/model/state.h"

namespace cutbench {

namespace {

template <int D>
Field mass_times(const Model<D>& model, const Field& x) {
  Field y = Field::Zero(x.size());
  model.add_mass_product(1, x, y);
  return y;
}

/// Of all but the pins.
template <int D>
Field force_at(Model<D>& model, const Field& x) {
  model.rotate_once(x);
  Field force = Field::Zero(x.size());
  model.add_internal_force(x, force);
  model.add_external_force(force);
  return force;
}

/// K w from the matrix of the step: A = (1 + s alpha) M + (s beta + s^2) K, where s is the step or half of it; of the
/// explicit step beta K, or nothing.
template <int D>
Field stiffness_times(const Model<D>& model, const SystemMatrix<D>& a, const Field& w, const Field& mass_w,
                      bool is_explicit, double s) {
  const double alpha = model.material().mass_damping, beta = model.material().stiffness_damping;
  Field product = Field::Zero(w.size());
  if (is_explicit && beta == 0) return product;
  a.add_product(w, product);
  if (is_explicit) return product / beta;
  return (product - (1 + s * alpha) * mass_w) / (s * beta + s * s);
}

}  // namespace

EnergyBudget::EnergyBudget(const Balance& first, Integrator integrator, double noise, double time, bool robust)
    : integrator_(integrator), exact_loss_(robust && integrator == Integrator::backward_euler), scale_(noise) {
  rows_.push_back({.time = time, .energy = first.energy});
  judge_last();
}

template <int D>
void EnergyBudget::add_step(Model<D>& model, const State& before, const State& after, double step,
                            const SystemMatrix<D>* damping_matrix) {
  const double alpha = model.material().mass_damping, beta = model.material().stiffness_damping;
  const bool is_explicit = integrator_ == Integrator::symplectic_euler, midpoint = integrator_ == Integrator::midpoint;
  const Field mean_v = (before.v + after.v) / 2;
  Field u = midpoint ? mean_v : after.v;
  for (std::size_t i = 0; i < model.held().size() && midpoint; ++i)  // a pin sets off at once
    if (model.pinned(i)) u[to_index(i)] = after.v[to_index(i)];
  const Field dv = (midpoint ? 2 : 1) * (u - before.v);
  const Field& w = is_explicit ? before.v : u;
  const Field mass_w = mass_times(model, w), mass_dv = mass_times(model, dv);
  const SystemMatrix<D> a = damping_matrix ? *damping_matrix : model.system();
  const Field stiffness_w = stiffness_times(model, a, w, mass_w, is_explicit, midpoint ? step / 2 : step);

  BudgetRow row = rows_.back();
  row.time = after.time;
  const Field damping = alpha * mass_w + beta * stiffness_w;
  row.damping += step * u.dot(damping);
  const Field place = midpoint ? Field((before.x + after.x) / 2) : is_explicit ? before.x : after.x;
  const Field force = force_at(model, place);
  row.numerical_loss += u.dot(mass_dv) - mean_v.dot(mass_times<D>(model, after.v - before.v));
  if (is_explicit)
    row.numerical_loss += step * u.dot(force_at(model, after.x) - force) / 2;
  else if (!midpoint && !exact_loss_)
    row.numerical_loss += step * step * u.dot(stiffness_w) / 2;

  Field pin_force = mass_dv / step + damping - force;
  if (model.constrained()) model.constrained()->transfer_forces(model.held(), pin_force);
  for (std::size_t i = 0; i < model.held().size(); ++i)
    if (model.pinned(i)) row.pin_work += step * u[to_index(i)] * pin_force[to_index(i)];

  if (midpoint) model.rotate(after.x);
  row.energy = model.energy(after.x, after.v);
  if (exact_loss_) {
    const Energy &was = rows_.back().energy, &is = row.energy;
    row.numerical_loss += was.membrane - is.membrane + was.bending - is.bending + was.potential - is.potential -
                          (after.x - before.x).dot(force);
  }
  const double change = row.energy.total() - rows_.front().energy.total();
  row.remainder = change - row.jumps - row.pin_work + row.damping + row.numerical_loss;
  count_jump(row.numerical_loss - rows_.back().numerical_loss);
  rows_.push_back(row);
  judge_last();
}

/// \param loss  J: numerical, of the step
void EnergyBudget::count_jump(double loss) {
  if (has_cut_)
    counted_jumps_ += new_jump_ - std::clamp(loss - usual_loss_, 0.0, std::max(new_jump_, 0.0));
  else
    usual_loss_ = loss;
  new_jump_ = 0;
  has_cut_ = false;
}

void EnergyBudget::add_cut(const Balance& before, const Balance& after, bool keeps_mass) {
  double jump = after.energy.total() - before.energy.total();
  if (!keeps_mass) jump -= after.energy.potential - before.energy.potential;
  (exact_loss_ ? new_jump_ : counted_jumps_) += jump;
  has_cut_ = true;
  rows_.back().jumps += after.energy.total() - before.energy.total();
  rows_.back().energy = after.energy;
  judge_last();
}

void EnergyBudget::add_work(const Balance& before, const Balance& after) {
  if (rows_.size() > 1) rows_.back().pin_work += after.energy.total() - before.energy.total();  // else it begins so
  rows_.back().energy = after.energy;
  judge_last();
}

void EnergyBudget::judge_last() {
  if (judged_rows_ > 0) return;
  const BudgetRow& row = rows_.back();
  // Potential energy has rounding errors of its own size.
  scale_ = std::max(
      {scale_, row.energy.kinetic + row.energy.membrane + row.energy.bending, 1e-12 * std::abs(row.energy.potential)});
  remainder_.add(row.remainder);
  jumps_.add(counted_jumps_);
  unexplained_.add(row.energy.total() - rows_.front().energy.total() - row.pin_work - row.jumps);
}

EnergyBudget::Gains EnergyBudget::gains() const {
  if (scale_ == 0) return {};
  return {remainder_.largest / scale_, jumps_.largest / scale_, unexplained_.largest / scale_};
}

std::string EnergyBudget::fault() const {
  const Gains gained = gains();
  const bool is_explicit = integrator_ == Integrator::symplectic_euler;
  const auto say = [](const char* what, double gain) {
    char text[112];
    std::snprintf(text, sizeof text, "%s rose by %.2g %% of the kinetic and elastic energy", what, 100 * gain);
    return std::string(text);
  };
  if (!is_explicit && gained.remainder > most_remainder) return say("the remainder of the energy", gained.remainder);
  if (gained.unexplained > (is_explicit ? most_unexplained_explicit : most_unexplained))
    return say("the energy, less work and jumps,", gained.unexplained);
  if (gained.jumps > most_jumps) return say("by jumps at cuts the energy", gained.jumps);
  return {};
}

std::string EnergyBudget::csv() const {
  std::string text =
      "time_s,membrane_j,bending_j,kinetic_j,potential_j,pin_work_j,damping_j,numerical_loss_j,jumps_j,remainder_j\n";
  for (const BudgetRow& r : rows_) {
    char line[256];
    std::snprintf(line, sizeof line, "%.10g,%.10g,%.10g,%.10g,%.10g,%.10g,%.10g,%.10g,%.10g,%.10g\n", r.time,
                  r.energy.membrane, r.energy.bending, r.energy.kinetic, r.energy.potential, r.pin_work, r.damping,
                  r.numerical_loss, r.jumps, r.remainder);
    text += line;
  }
  return text;
}

template void EnergyBudget::add_step(Model<2>&, const State&, const State&, double, const SystemMatrix<2>*);
template void EnergyBudget::add_step(Model<3>&, const State&, const State&, double, const SystemMatrix<3>*);

}  // namespace cutbench
