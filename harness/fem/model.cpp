#include "harness/fem/model.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/base/errors.h"

namespace cutbench {

namespace {

std::array<double, 3> coordinates(Point3 p) { return {p.x, p.y, p.z}; }

}  // namespace

template <int D>
Model<D>::Model(const Sheet& sheet, const Material& material, const Physics& physics, std::vector<Pin> pins,
                std::vector<Traction> tractions)
    : material_(material),
      physics_(physics),
      pins_(std::move(pins)),
      tractions_(std::move(tractions)),
      elements_(sheet),
      membrane_(law_of(material, physics), physics.bending != BendingKind::none) {
  if (physics.mass == Mass::consistent) consistent_mass_.emplace();
  resize(sheet);
  ++round_;
  for (std::size_t e = 0; e < elements_.size(); ++e)
    if (elements_[e].alive()) incidence_.add(elements_[e], e);
  for (std::size_t v = 0; v < vertices(); ++v) marked_.push_back(v);
  refresh_vertices(sheet);
  if (physics.bending != BendingKind::none)
    bending_.emplace(sheet, physics.bending, material.bending, material.poisson);
  if (!adds_mass(physics.mass)) return;
  added_mass_.emplace(physics.mass, material.density, physics.mass_limit * element_modes().largest());
  refresh_added_mass();
}

template <int D>
void Model<D>::reserve_spare() {
  elements_.reserve_spare(), blocks_.reserve_spare(), incidence_.reserve_spare(), membrane_.reserve_spare();
  polygons_of_.reserve_spare();
  cutbench::reserve_spare(mass_, external_, held_, pin_of_, places_, marked_in_);
  if (consistent_mass_) consistent_mass_->reserve_spare();
  if (bending_) bending_->reserve_spare();
}

template <int D>
void Model<D>::update(const Sheet& sheet) {
  const EditLog& log = sheet.log();
  is_tied_ = false;
  freed_.clear();
  begin_marking();
  for (const auto& touched : log.touched) {
    if (!touched.before.alive()) continue;
    if (elements_[touched.slot()].polygon >= 0) {
      const auto members = elements_.members(touched.slot);
      freed_.insert(freed_.end(), members.begin(), members.end());
      dissolve(static_cast<std::size_t>(elements_[touched.slot()].polygon));
    }
    incidence_.remove(touched.before.deformed, touched.slot());
    mark(touched.before.deformed);
  }
  elements_.update(sheet);
  resize(sheet);
  const auto enter = [&](std::size_t e) {
    if (!elements_[e].alive()) return membrane_.clear_slots(e);
    incidence_.add(elements_[e], e);
    mark(elements_[e].vertex);
  };
  for (const auto& touched : log.touched) enter(touched.slot());
  for (std::size_t e = log.triangles_before; e < elements_.size(); ++e) enter(e);
  refresh_vertices(sheet);
  if (!bending_) refresh_added_mass();
}

template <int D>
void Model<D>::update_bending(const Sheet& sheet) {
  if (!bending_) return regrouped_.clear();
  bending_->update(sheet, &elements_, regrouped_);
  regrouped_.clear();
  history_.begin_change();
  for (const std::int32_t v : bending_->written_rows()) history_.mark(static_cast<std::size_t>(v));
  if (!added_mass_) return;
  for (const std::int32_t v : bending_->written_rows()) {
    const DeformedIndex d(static_cast<std::size_t>(v));
    mark({&d, 1});
  }
  refresh_added_mass();
}

template <int D>
void Model<D>::tie(const Sheet& sheet, const Ties& ties) {
  begin_marking();
  merge(sheet, ties.polygons);
  refresh_vertices(sheet);
  if (!bending_) refresh_added_mass();
  if (!regrouped_.empty()) update_bending(sheet);
  is_tied_ = !ties.ties.empty();
  if (is_tied_ && tied_)
    tied_->change(ties, vertices());
  else if (is_tied_)
    tied_.emplace(ties, vertices());
}

template <int D>
void Model<D>::merge(const Sheet& sheet, std::span<const Polygon> polygons) {
  if (physics_.strain == Strain::springs && !polygons.empty())
    throw InputError("a polygon has no springs: take another method than cut_polygons, or another \"strain\"");
  for (const Polygon& polygon : polygons) {
    const TriangleIndex first = polygon.triangles.front();
    if (std::ranges::equal(elements_.members(first), polygon.triangles)) continue;  // it is there already
    for (const TriangleIndex t : polygon.triangles)
      if (const auto old = elements_[t()].polygon; old >= 0) dissolve(static_cast<std::size_t>(old));
    const std::size_t slot = elements_.add_polygon(sheet, polygon);
    membrane_.polygons().reset(slot, elements_.polygon(slot));
    for (const TriangleIndex t : polygon.triangles) membrane_.clear_slots(t()), regrouped_.push_back(t);
    for (const DeformedIndex d : polygon.corners) polygons_of_.append(d(), static_cast<std::int32_t>(slot));
    mark(polygon.corners), mark(polygon.inside);
  }
}

template <int D>
void Model<D>::dissolve(std::size_t polygon) {
  const Polygon& gone = elements_.polygon(polygon).polygon;
  for (const DeformedIndex d : gone.corners) polygons_of_.erase(d(), static_cast<std::int32_t>(polygon));
  mark(gone.corners), mark(gone.inside);
  regrouped_.insert(regrouped_.end(), gone.triangles.begin(), gone.triangles.end());
  elements_.dissolve(polygon);
}

template <int D>
std::vector<Polygon> Model<D>::polygons() const {
  std::vector<Polygon> all;
  for (std::size_t p = 0; p < elements_.polygon_slots(); ++p)
    if (elements_.polygon(p).alive()) all.push_back(elements_.polygon(p).polygon);
  return all;
}

template <int D>
PolygonsLeft Model<D>::polygons_left() const {
  const auto of = [this](TriangleIndex t) {
    return elements_[t()].polygon < 0 ? std::span<const TriangleIndex>{} : elements_.members(t);
  };
  return {of, freed_};
}

template <int D>
void Model<D>::follow(Field& x) const {
  for (std::size_t p = 0; p < elements_.polygon_slots(); ++p) {
    const PolygonElement& polygon = elements_.polygon(p);
    if (polygon.inside.empty()) continue;
    const LinearMap<D> map = polygon.template map<D>(x);
    for (std::size_t i = 0; i < polygon.inside.size(); ++i)
      x.template segment<D>(D * polygon.polygon.inside[i].value) = map.at(polygon.inside[i]);
  }
}

template <int D>
void Model<D>::begin_marking() {
  ++round_;
  marked_.clear();
}

template <int D>
void Model<D>::mark(std::span<const DeformedIndex> vertices) {
  for (const auto d : vertices) {
    if (d() >= marked_in_.size()) marked_in_.resize(d() + 1);
    if (std::exchange(marked_in_[d()], round_) != round_) marked_.push_back(d());
  }
}

template <int D>
void Model<D>::resize(const Sheet& sheet) {
  const std::size_t n = sheet.deformed_slots();
  incidence_.resize(n), polygons_of_.resize(n), blocks_.resize(n), marked_in_.resize(std::max(n, marked_in_.size()));
  if (consistent_mass_) consistent_mass_->resize(n);
  held_.resize(D * n, 1), pin_of_.resize(D * n, -1), places_.resize(n);
  membrane_.resize(elements_.size());
  mass_.resize(n), external_.resize(D * n);
}

template <int D>
void Model<D>::refresh_vertices(const Sheet& sheet) {
  for (const std::size_t v : marked_) refresh_row(v), refresh_mass(v), refresh_loads(sheet, v);
  history_.begin_change();
  for (const std::size_t v : marked_) history_.mark(v);
}

/// The pattern of row v, and where the elements round v find their blocks in it.
template <int D>
void Model<D>::refresh_row(std::size_t v) {
  const auto corners = incidence_.at(v);
  columns_.clear();
  const auto add = [&](std::span<const DeformedIndex> with) {
    if (columns_.empty()) columns_.push_back(static_cast<std::int32_t>(v));
    for (const auto d : with)
      if (std::find(columns_.begin(), columns_.end(), d.value) == columns_.end()) columns_.push_back(d.value);
  };
  for (const auto c : corners)
    if (const Element& e = elements_[triangle_of(c)()]; e.is_triangle()) add(e.vertex);
  for (const std::int32_t p : polygons_of_[v]) add(elements_.polygon(static_cast<std::size_t>(p)).polygon.corners);
  blocks_.set_row(v, columns_);
  set_polygon_slots(v);
  for (const auto c : corners) {
    const std::size_t e = triangle_of(c)();
    if (!elements_[e].is_triangle()) continue;
    for (std::size_t j = 0; j < 3; ++j)
      membrane_.set_slot(e, static_cast<std::size_t>(corner_of(c)), j, blocks_.find(v, elements_[e].vertex[j].value));
  }
}

template <int D>
void Model<D>::set_polygon_slots(std::size_t v) {
  for (const std::int32_t p : polygons_of_[v]) {
    const auto slot = static_cast<std::size_t>(p);
    const auto& corners = elements_.polygon(slot).polygon.corners;
    polygon_slots_.clear();
    for (const auto d : corners) polygon_slots_.push_back(blocks_.find(v, d.value));
    const auto own = std::find(corners.begin(), corners.end(), DeformedIndex(v));
    membrane_.polygons().set_slots(slot, static_cast<std::size_t>(own - corners.begin()), polygon_slots_);
  }
}

template <int D>
void Model<D>::refresh_mass(std::size_t v) {
  double third = 0, of_polygons = 0;
  for (const auto c : incidence_.at(v))
    if (const Element& e = elements_[triangle_of(c)()]; e.is_triangle()) third += e.material_area();
  for (const std::int32_t p : polygons_of_[v])
    of_polygons += elements_.polygon(static_cast<std::size_t>(p)).corner_area();
  mass_[v] = material_.density * (third / 3 + of_polygons);
  if (!consistent_mass_) return;
  consistent_mass_->set_row(v, columns_);
  if (of_polygons > 0) consistent_mass_->block(consistent_mass_->first_slot(v))(0) += material_.density * of_polygons;
  for (const auto c : incidence_.at(v)) {
    const Element& e = elements_[triangle_of(c)()];
    if (!e.is_triangle()) continue;
    for (const auto d : e.vertex)
      consistent_mass_->block(consistent_mass_->find(v, d.value))(0) +=
          material_.density * e.material_area() / (d() == v ? 6 : 12);
  }
}

template <int D>
ElementModes Model<D>::element_modes() const {
  const Lame lame = lame_of(material_, physics_.plane);
  return {&elements_, view_of(mass_), bending(), 2 * (lame.mu + lame.lambda) / material_.density};
}

/// \pre the marked vertices are those whose mass, triangles or stencils changed.
template <int D>
void Model<D>::refresh_added_mass() {
  if (!added_mass_) return;
  added_mass_->update(element_modes(), incidence_, marked_);
  history_.begin_change();
  for (const std::size_t v : added_mass_->written_rows()) history_.mark(v);
}

/// The part of the mass that is not in the blocks; null: none.
template <int D>
const BlockMatrix<1>* Model<D>::mass_matrix() const {
  return consistent_mass_ ? &*consistent_mass_ : added_mass_ ? &added_mass_->matrix() : nullptr;
}

template <int D>
void Model<D>::refresh_loads(const Sheet& sheet, std::size_t v) {
  const VertexIndex rest_vertex = sheet.rest_vertex(DeformedIndex(v));
  const auto gravity = coordinates(physics_.gravity);
  for (std::size_t k = 0; k < D; ++k) {
    external_[D * v + k] = mass_[v] * gravity[k];
    held_[D * v + k] = 1, pin_of_[D * v + k] = -1;
  }
  if (!rest_vertex.valid()) return;
  const Point2 rest = places_[v] = sheet.rest(rest_vertex);
  if (blocks_.columns(v).empty()) return;  // inside a polygon
  for (std::size_t k = 0; k < D; ++k) {
    for (std::size_t p = 0; p < pins_.size() && pin_of_[D * v + k] < 0; ++p)
      if (pins_[p].axes[k] && pins_[p].where.contains(rest)) pin_of_[D * v + k] = static_cast<std::int16_t>(p);
    held_[D * v + k] = pin_of_[D * v + k] >= 0;
  }
  if (tractions_.empty()) return;
  for (const auto c : incidence_.at(v))
    for (const HalfEdge h : {c, Sheet::previous(c)}) {
      if (!sheet.on_border(h)) continue;
      const Point2 a = sheet.rest(sheet.origin(h)), b = sheet.rest(sheet.target(h));
      for (const Traction& traction : tractions_) {
        if (!traction.where.contains(a) || !traction.where.contains(b)) continue;
        const auto force = coordinates(traction.force);
        for (std::size_t k = 0; k < D; ++k) external_[D * v + k] += force[k] * std::sqrt(squared_length(b - a)) / 2;
      }
    }
}

template <int D>
Field Model<D>::positions(const Sheet& sheet) const {
  Field x = Field::Zero(static_cast<Eigen::Index>(D * sheet.deformed_slots()));
  for (std::size_t v = 0; v < sheet.deformed_slots(); ++v) {
    const auto p = coordinates(sheet.position(DeformedIndex(v)));
    for (std::size_t k = 0; k < D; ++k) x[static_cast<Eigen::Index>(D * v + k)] = p[k];
  }
  return x;
}

template <int D>
double Model<D>::held_displacement(std::size_t unknown, double time) const {
  const Pin& pin = pins_[static_cast<std::size_t>(pin_of_[unknown])];
  return coordinates(pin.displacement)[unknown % D] + held_velocity(unknown) * time;
}

template <int D>
double Model<D>::held_velocity(std::size_t unknown) const {
  return coordinates(pins_[static_cast<std::size_t>(pin_of_[unknown])].velocity)[unknown % D];
}

template <int D>
std::size_t Model<D>::unheld_pieces() const {
  std::vector<std::uint8_t> seen(vertices());
  std::vector<std::size_t> front;
  std::size_t unheld = 0;
  for (std::size_t start = 0; start < vertices(); ++start) {
    if (seen[start] || blocks_.columns(start).empty()) continue;
    bool held = false;
    front.assign(1, start);
    seen[start] = 1;
    while (!front.empty()) {
      const std::size_t v = front.back();
      front.pop_back();
      for (std::size_t k = 0; k < D; ++k) held |= held_[D * v + k] != 0;
      for (const auto j : blocks_.columns(v))
        if (!std::exchange(seen[static_cast<std::size_t>(j)], 1)) front.push_back(static_cast<std::size_t>(j));
    }
    unheld += !held;
  }
  return unheld;
}

// --- of a state ------------------------------------------------------------------------------------------------------

template <int D>
void Model<D>::rotate(const Field& x) {
  membrane_.rotate(elements_, x);
}

template <int D>
void Model<D>::add_internal_force(const Field& x, Field& f) const {
  f += membrane_.force();
  if (bending_) add_product_per_coordinate(bending_->matrix(), D, -1, x, f);
}

template <int D>
void Model<D>::add_impulse(double h, const Field& x, double factor, const Field& v, Field& y) {
  y += h * membrane_.force();
  velocity_.resize(vertices()), bent_.resize(vertices());
  for (std::size_t i = 0; i < vertices(); ++i) {
    Lanes at{};
    for (std::size_t k = 0; k < D; ++k)
      velocity_[i][k] = v[static_cast<Eigen::Index>(D * i + k)], at[k] = x[static_cast<Eigen::Index>(D * i + k)];
    bent_[i] =
        h * at + factor * stiffness_factor_ * velocity_[i];  // K_b (h x) and factor stiffness_factor K_b v at once
  }
  for (std::size_t i = 0; i < vertices(); ++i) {
    Lanes sum = factor * blocks_.row_product(i, velocity_);
    if (bending_) sum += bending_->matrix().row_product(i, bent_);
    for (std::size_t k = 0; k < D; ++k) y[static_cast<Eigen::Index>(D * i + k)] -= sum[k];
  }
  if (const auto* mass = mass_matrix()) add_product_per_coordinate(*mass, D, -factor * mass_factor_, v, y);
}

template <int D>
void Model<D>::assemble(double mass_factor, double stiffness_factor) {
  mass_factor_ = mass_factor, stiffness_factor_ = stiffness_factor;
  blocks_.set_zero();
  membrane_.add_stiffness(elements_, stiffness_factor, blocks_);
  if (consistent_mass_) return;
  for (std::size_t v = 0; v < vertices(); ++v)
    if (!blocks_.columns(v).empty()) blocks_.block(blocks_.first_slot(v)).diagonal().array() += mass_factor * mass_[v];
}

template <int D>
SystemMatrix<D> Model<D>::system() const {
  SystemMatrix<D> a;
  a.blocks = &blocks_, a.held = &held_, a.elements = &elements_, a.places = &places_, a.pattern = history_.now();
  a.history = &history_;
  if (bending_) a.scalar.push_back({stiffness_factor_, &bending_->matrix()});
  if (const auto* mass = mass_matrix()) a.scalar.push_back({mass_factor_, mass});
  return a;
}

template <int D>
void Model<D>::add_mass_product(double factor, const Field& x, Field& y) const {
  if (const auto* mass = mass_matrix()) add_product_per_coordinate(*mass, D, factor, x, y);
  if (consistent_mass_) return;
  for (std::size_t v = 0; v < mass_.size(); ++v) {
    const auto at = static_cast<Eigen::Index>(D * v);
    y.template segment<D>(at) += factor * mass_[v] * x.template segment<D>(at);
  }
}

template <int D>
Energy Model<D>::energy(const Field& x, const Field& v) const {
  Energy energy;
  energy.membrane = membrane_.energy(elements_);
  if (bending_) energy.bending = bending_->energy(x, D);
  Field momentum = Field::Zero(v.size());
  add_mass_product(1, v, momentum);
  energy.kinetic = v.dot(momentum) / 2;
  energy.potential = -external_force().dot(x);
  return energy;
}

template class Model<2>;
template class Model<3>;

}  // namespace cutbench
