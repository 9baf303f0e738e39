#include "solver/contact/neighbours.hpp"

#include <algorithm>
#include <cmath>

namespace granulaw {

namespace {

/// Equal cells of a box, each with its bodies.
class CellGrid
{
 public:
  CellGrid(std::span<const Vector3> centres, double widest, const PackingBox& box) : box_(box)
  {
    for (int d = 0; d < 3; ++d) {
      low_[d] = 0, edge_[d] = box.length[d];
      if (!box.periodic)  // a body may be pressed out of a wall's reach for a moment
        for (const Vector3& x : centres) low_[d] = std::min(low_[d], x[d]);
      count_[d] = std::clamp(static_cast<int>(box.length[d] / widest), 1, 64);
      edge_[d] /= count_[d];
      around_[d] = static_cast<int>(std::ceil(widest / edge_[d]));
    }
    bodies_.resize(std::size_t(count_[0]) * count_[1] * count_[2]);
    for (const Vector3& x : centres) {
      Place place;
      for (int d = 0; d < 3; ++d) {
        const int cell = static_cast<int>(std::floor((x[d] - low_[d]) / edge_[d]));
        place.boxes[d] = box.periodic ? floor_of(cell, count_[d]) : 0;
        place.cell[d] = box.periodic ? cell - place.boxes[d] * count_[d] : std::clamp(cell, 0, count_[d] - 1);
      }
      bodies_[number(place.cell)].push_back(static_cast<int>(places_.size()));
      places_.push_back(place);
    }
  }

  /// Calls visit(b, image) for every body b near the body `a`; `image`: boxes by which a moves to meet b.
  template <class Visit>
  void visit_near(int a, Visit visit) const
  {
    const Place& own = places_[a];
    std::array<int, 3> step;
    for (step[0] = -around_[0]; step[0] <= around_[0]; ++step[0])
      for (step[1] = -around_[1]; step[1] <= around_[1]; ++step[1])
        for (step[2] = -around_[2]; step[2] <= around_[2]; ++step[2]) {
          std::array<int, 3> cell, boxes{};
          bool inside = true;
          for (int d = 0; d < 3; ++d) {
            cell[d] = own.cell[d] + step[d];
            if (box_.periodic)
              boxes[d] = floor_of(cell[d], count_[d]), cell[d] -= boxes[d] * count_[d];
            else
              inside = inside && cell[d] >= 0 && cell[d] < count_[d];
          }
          if (!inside) continue;
          for (const int b : bodies_[number(cell)]) {
            std::array<int, 3> image;
            for (int d = 0; d < 3; ++d) image[d] = places_[b].boxes[d] - own.boxes[d] - boxes[d];
            visit(b, image);
          }
        }
  }

 private:
  struct Place
  {
    std::array<int, 3> cell, boxes;
  };
  static int floor_of(int a, int b) { return (a >= 0 ? a : a - b + 1) / b; }
  std::size_t number(const std::array<int, 3>& cell) const
  {
    return (std::size_t(cell[2]) * count_[1] + cell[1]) * count_[0] + cell[0];
  }

  const PackingBox& box_;
  double low_[3], edge_[3];
  int count_[3], around_[3];
  std::vector<Place> places_;
  std::vector<std::vector<int>> bodies_;
};

}  // namespace

std::vector<Neighbours> find_neighbours(std::span<const Vector3> centres, std::span<const double> reach,
                                        double margin, const PackingBox& box)
{
  const double widest = 2 * *std::max_element(reach.begin(), reach.end()) + margin;
  const CellGrid grid(centres, widest, box);
  std::vector<Neighbours> found;
  for (int a = 0; a < static_cast<int>(centres.size()); ++a)
    grid.visit_near(a, [&](int b, const std::array<int, 3>& image) {
      if (b < a || (b == a && image <= std::array<int, 3>{})) return;
      const double near = reach[a] + reach[b] + margin;
      if ((centres[a] + box.shift(image) - centres[b]).squaredNorm() < near * near)
        found.push_back({a, b, image});
    });
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace granulaw
