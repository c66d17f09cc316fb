#include "description/solid_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace navvi_sim {
namespace {

constexpr std::uint32_t kRings = 16;    // from pole to pole
constexpr std::uint32_t kSectors = 32;  // around
constexpr std::size_t kMaxCorners = 300;

using Outline = std::vector<Eigen::Vector2d>;

/// Twice the area of a triangle, > 0 if it turns to the left.
double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

double doubled_area(const Outline& outline) {
  double sum = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& next = outline[(i + 1) % outline.size()];
    sum += outline[i].x() * next.y() - outline[i].y() * next.x();
  }
  return sum;
}

/// Whether the corner `i` of what is `left` of the outline can be cut off.
bool is_ear(const Outline& outline, const std::vector<std::uint32_t>& left, std::size_t i) {
  const std::uint32_t before = left[(i + left.size() - 1) % left.size()];
  const std::uint32_t after = left[(i + 1) % left.size()];
  const Eigen::Vector2d& a = outline[before];
  const Eigen::Vector2d& b = outline[left[i]];
  const Eigen::Vector2d& c = outline[after];
  if (!(turn(a, b, c) >= 0.0)) return false;
  return std::none_of(left.begin(), left.end(), [&](std::uint32_t other) {
    if (other == before || other == left[i] || other == after) return false;
    const Eigen::Vector2d& p = outline[other];
    return turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
  });
}

/// A polygon in triangles by cutting ears (Meisters, 1975); fewer than corners - 2 if its sides
/// cross.
std::vector<std::array<std::uint32_t, 3>> triangles_of(const Outline& outline) {
  std::vector<std::uint32_t> left(outline.size());
  std::iota(left.begin(), left.end(), 0U);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::size_t tried = 0;
  for (std::size_t i = 0; left.size() > 2 && tried < left.size();) {
    i %= left.size();
    if (!is_ear(outline, left, i)) {
      ++i;
      ++tried;
      continue;
    }
    triangles.push_back(
        {left[(i + left.size() - 1) % left.size()], left[i], left[(i + 1) % left.size()]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
    tried = 0;
  }
  return triangles;
}

/// Neither a corner twice in a row nor one on the line between its neighbours.
void simplify(Outline& outline) {
  for (std::size_t i = 0; outline.size() > 2 && i < outline.size();) {
    const Eigen::Vector2d& before = outline[(i + outline.size() - 1) % outline.size()];
    const Eigen::Vector2d& after = outline[(i + 1) % outline.size()];
    if (std::abs(turn(before, outline[i], after)) < 1e-12)
      outline.erase(outline.begin() + static_cast<std::ptrdiff_t>(i));
    else
      ++i;
  }
}

}  // namespace

Mesh ellipsoid_mesh(const Eigen::Vector3d& radii) {
  Mesh mesh;
  for (std::uint32_t ring = 0; ring <= kRings; ++ring)
    for (std::uint32_t sector = 0; sector < kSectors; ++sector) {
      const double polar = kPi * ring / kRings;
      const double around = 2.0 * kPi * sector / kSectors;
      const Eigen::Vector3d unit(std::sin(polar) * std::cos(around),
                                 std::sin(polar) * std::sin(around), std::cos(polar));
      mesh.vertices.push_back(radii.cwiseProduct(unit).cast<float>());
    }
  for (std::uint32_t ring = 0; ring < kRings; ++ring)
    for (std::uint32_t sector = 0; sector < kSectors; ++sector) {
      const std::uint32_t a = ring * kSectors + sector;
      const std::uint32_t b = ring * kSectors + (sector + 1) % kSectors;
      if (ring > 0) mesh.triangles.push_back({a, a + kSectors, b});
      if (ring + 1 < kRings) mesh.triangles.push_back({b, a + kSectors, b + kSectors});
    }
  return mesh;
}

Mesh cone_mesh(double radius, double height) {
  Mesh mesh;
  for (const double z : {-height / 2.0, height / 2.0})
    mesh.vertices.push_back(Eigen::Vector3d(0.0, 0.0, z).cast<float>());
  for (std::uint32_t sector = 0; sector < kSectors; ++sector) {
    const double around = 2.0 * kPi * sector / kSectors;
    const Eigen::Vector3d rim(radius * std::cos(around), radius * std::sin(around), -height / 2.0);
    mesh.vertices.push_back(rim.cast<float>());
    const std::uint32_t a = 2 + sector;
    const std::uint32_t b = 2 + (sector + 1) % kSectors;
    mesh.triangles.push_back({0, b, a});
    mesh.triangles.push_back({1, a, b});
  }
  return mesh;
}

std::optional<Mesh> prism_mesh(Outline outline, double height) {
  if (outline.size() > kMaxCorners + 1) return std::nullopt;
  simplify(outline);
  if (outline.size() < 3) return std::nullopt;
  if (doubled_area(outline) < 0.0) std::reverse(outline.begin(), outline.end());
  const auto caps = triangles_of(outline);
  if (caps.size() + 2 != outline.size()) return std::nullopt;
  const auto count = static_cast<std::uint32_t>(outline.size());
  Mesh mesh;
  for (const double z : {0.0, height})
    for (const Eigen::Vector2d& corner : outline)
      mesh.vertices.push_back(Eigen::Vector3d(corner.x(), corner.y(), z).cast<float>());
  for (const auto& [a, b, c] : caps) {
    mesh.triangles.push_back({c, b, a});
    mesh.triangles.push_back({a + count, b + count, c + count});
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t next = (i + 1) % count;
    mesh.triangles.push_back({i, next, i + count});
    mesh.triangles.push_back({next, next + count, i + count});
  }
  return mesh;
}

}  // namespace navvi_sim
