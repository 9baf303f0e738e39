#include "solver/grid/updated_body.hpp"

#include "base/error.hpp"
#include "solver/body/updated_points.hpp"

namespace granulaw {

namespace {

constexpr double updated_growth = 1.15, updated_coarsest = 0.15;
/// Room beside and above the body for what flows outwards and for the rebound, in R.
constexpr double margin = 0.3;

}  // namespace

Body updated_body(const CutSection& s)
{
  MovingPoints m;
  m.r_axis = SplineAxis(graded_lines(0, s.block, s.radius + margin, s.fine, updated_growth, updated_coarsest, s.shift));
  m.z_axis = SplineAxis(graded_lines(0, s.depth, s.height + margin, s.fine, updated_growth, updated_coarsest));
  const std::vector<Piece> pieces = cut_pieces(s, m.r_axis, m.z_axis);
  if (pieces.empty()) fail("grid", "no part of the body lies on it");
  const int count = static_cast<int>(pieces.size());

  Reference& own = m.own;
  own.resize_nodes(m.r_axis.functions() * m.z_axis.functions(), 2);
  own.resize_corners(count, 9);
  own.regions = regions_of(s.phases, pieces);
  for (int i = 0; i < m.r_axis.functions(); ++i)
    for (int j = 0; j < m.z_axis.functions(); ++j) {
      const int node = i * m.z_axis.functions() + j;
      own.place_i(node, 0) = m.r_axis.node(i), own.place_i(node, 1) = m.z_axis.node(j);
    }
  for (auto* field :
       {&m.r, &m.z, &m.mass, &m.vr, &m.vz, &m.crr, &m.crz, &m.czr, &m.czz, &m.trr, &m.tzz, &m.trz, &m.thh})
    field->assign(count, 0.0);
  double sampled = 0;
  for (const Piece& p : pieces) sampled += s.phases[p.phase].density * p.volume;
  const double scale = s.mass > 0 ? s.mass / sampled : 1;
  for (int p = 0; p < count; ++p) {
    m.r[p] = pieces[p].r, m.z[p] = pieces[p].z;
    m.mass[p] = scale * s.phases[pieces[p].phase].density * pieces[p].volume;
    own.volume_p[p] = pieces[p].volume;
  }
  own.surface = section_markers(s, m.r_axis, 2);  // points and columns drift apart: one could be missed
  own.mass = scale * sampled;
  Body b(own);
  b.moving = std::move(m);
  updated_points_to_grid(b);
  return b;
}

}  // namespace granulaw
