#include "plan/carving.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace navvi_nav::plan {
namespace {

/// Of a hole: 8 lose nothing along axes and diagonals and 8 % at most between.
constexpr int kHoleSides = 8;

double area(double radius) { return kPi * radius * radius; }

/// m^2, of the part that two circles share
double shared_area(double d, double r, double s) {
  if (d >= r + s) return 0.0;
  if (d <= std::abs(r - s)) return area(std::min(r, s));
  const double a = std::acos(std::clamp((d * d + r * r - s * s) / (2 * d * r), -1.0, 1.0));
  const double b = std::acos(std::clamp((d * d + s * s - r * r) / (2 * d * s), -1.0, 1.0));
  return r * r * (a - std::sin(2 * a) / 2) + s * s * (b - std::sin(2 * b) / 2);
}

}  // namespace

int Carving::carve(mesh::CutMesh& mesh, const std::vector<Cylinder>& cylinders) {
  const auto by_id = [](const Cylinder& a, const Cylinder& b) { return a.id < b.id; };
  next_ = cylinders;
  if (!std::is_sorted(next_.begin(), next_.end(), by_id))
    std::stable_sort(next_.begin(), next_.end(), by_id);
  pair_up();
  const auto keeps_hole = [this](const Pair& pair) {
    if (pair.before < 0 || pair.after < 0) return false;
    const Cylinder& before = carved_[slot(pair.before)];
    const Cylinder& after = next_[slot(pair.after)];
    return before.center == after.center && before.radius == after.radius;
  };
  if (std::all_of(pairs_.begin(), pairs_.end(), keeps_hole) || !changed_enough()) return 0;
  next_holes_.resize(next_.size());
  for (const Pair& pair : pairs_) {
    if (keeps_hole(pair)) {
      next_holes_[slot(pair.after)] = holes_[slot(pair.before)];
      continue;
    }
    if (pair.before >= 0) mesh.remove(holes_[slot(pair.before)]);
    if (pair.after < 0) continue;
    const Cylinder& cylinder = next_[slot(pair.after)];
    next_holes_[slot(pair.after)] =
        mesh.add(cylinder.center, cylinder.radius + rules_.room, kHoleSides);
  }
  std::swap(carved_, next_);
  std::swap(holes_, next_holes_);
  return mesh.update();
}

void Carving::lift(mesh::CutMesh& mesh) {
  for (const int hole : holes_) mesh.remove(hole);
  mesh.update();
}

void Carving::repeat(mesh::CutMesh& mesh) {
  for (std::size_t i = 0; i < carved_.size(); ++i)
    holes_[i] = mesh.add(carved_[i].center, carved_[i].radius + rules_.room, kHoleSides);
  mesh.update();
}

/// By id; should one come twice, the first goes with the first.
void Carving::pair_up() {
  pairs_.clear();
  std::size_t i = 0, j = 0;
  while (i < carved_.size() || j < next_.size()) {
    const bool old = j == next_.size() || (i < carved_.size() && carved_[i].id <= next_[j].id);
    const bool fresh = i == carved_.size() || (j < next_.size() && next_[j].id <= carved_[i].id);
    pairs_.push_back({old ? static_cast<int>(i++) : -1, fresh ? static_cast<int>(j++) : -1});
  }
}

bool Carving::changed_enough() const {
  if (rules_.changed <= 0.0) return true;
  double total = 0.0, fresh = 0.0, kept = 0.0;
  for (const Cylinder& cylinder : carved_) total += area(cylinder.radius);
  for (const Cylinder& cylinder : next_) fresh += area(cylinder.radius);
  for (const Pair& pair : pairs_) {
    if (pair.before < 0 || pair.after < 0) continue;
    const Cylinder& before = carved_[slot(pair.before)];
    const Cylinder& after = next_[slot(pair.after)];
    kept += shared_area(distance(before.center, after.center), before.radius, after.radius);
  }
  const double changed = total + fresh - 2.0 * kept;
  return total <= 0.0 ? changed > 0.0 : changed > rules_.changed * total;
}

}  // namespace navvi_nav::plan
