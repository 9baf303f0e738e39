#include "liggghts_plugin/plan/sweep.hpp"

#include <algorithm>
#include <cmath>

#include "fix_move_mesh.h"
#include "liggghts_plugin/engine/private_members.hpp"
#include "mesh_mover_linear.h"
#include "mesh_mover_rotation.h"

namespace granulaw::plugin {

GRANULAW_EXPOSE(MoverOf, LAMMPS_NS::FixMoveMesh, move_);
GRANULAW_EXPOSE(MoveTime, LAMMPS_NS::FixMoveMesh, time_);
GRANULAW_EXPOSE(TimeSinceSetup, LAMMPS_NS::FixMoveMesh, time_since_setup_);

namespace plan {

namespace {

namespace lmp = LAMMPS_NS;
using NodeVectors = lmp::MultiVectorContainer<double, 3, 3>;

std::vector<lmp::FixMoveMesh*> moves_of(lmp::LAMMPS* lammps)
{
  std::vector<lmp::FixMoveMesh*> moves;
  for (int f = 0; f < lammps->modify->nfix; ++f)
    if (auto* move = dynamic_cast<lmp::FixMoveMesh*>(lammps->modify->fix[f])) moves.push_back(move);
  return moves;
}

NodeVectors* velocities_of(lmp::AbstractMesh& mesh)
{
  return mesh.prop().getElementProperty<NodeVectors>("v");
}

/// By one stride of `steps` time steps, as FixMoveMesh::initial_integrate does by one.
void move(lmp::FixMoveMesh& fix, double duration)
{
  lmp::MeshMover& mover = *(fix.*exposed(MoverOf{}));
  double &time = fix.*exposed(MoveTime{}), &since_setup = fix.*exposed(TimeSinceSetup{});
  time += duration;
  since_setup += duration;
  if (mover.isFirst()) velocities_of(*fix.mesh())->setAll(0.);
  mover.initial_integrate(time, since_setup, duration);
}

/// True: its displacement is its velocity times the stride, or the turn about its axis, however long the
/// stride.
bool takes_any_stride(lmp::FixMoveMesh& fix)
{
  lmp::MeshMover* mover = fix.*exposed(MoverOf{});
  return dynamic_cast<lmp::MeshMoverLinear*>(mover) || dynamic_cast<lmp::MeshMoverLinearVariable*>(mover) ||
         dynamic_cast<lmp::MeshMoverRotate*>(mover) || dynamic_cast<lmp::MeshMoverRotateVariable*>(mover);
}

std::vector<double> velocities(const std::vector<lmp::FixMoveMesh*>& moves)
{
  std::vector<double> all;
  for (lmp::FixMoveMesh* fix : moves) {
    NodeVectors& v = *velocities_of(*fix->mesh());
    for (int i = 0; i < v.size(); ++i)
      for (int j = 0; j < 3; ++j) all.insert(all.end(), v.begin()[i][j], v.begin()[i][j] + 3);
  }
  return all;
}

double largest(const std::vector<double>& values)
{
  double most = 0;
  for (const double x : values) most = std::max(most, std::abs(x));
  return most;
}

double largest_change(const std::vector<double>& a, const std::vector<double>& b)
{
  if (a.size() != b.size()) return 0;
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(a[k] - b[k]));
  return most;
}

}  // namespace

MeshView look_at(lmp::FixMeshSurface& fix)
{
  MeshView view;
  lmp::TriMesh& mesh = *fix.triMesh();
  NodeVectors* v = velocities_of(mesh);
  for (int i = 0; i < mesh.sizeLocal(); ++i) {
    MeshMotion::Triangle &corners = view.corners.emplace_back(), &velocities = view.velocities.emplace_back();
    for (std::size_t j = 0; j < 3; ++j) {
      mesh.node(i, static_cast<int>(j), corners[j].data());
      view.box.include(corners[j]);
      if (v) std::copy_n(v->begin()[i][j], 3, velocities[j].begin());
    }
  }
  return view;
}

bool is_moved(lmp::LAMMPS* lammps, const lmp::FixMeshSurface& mesh)
{
  const auto moves = moves_of(lammps);
  return std::any_of(moves.begin(), moves.end(),
                     [&](const auto* move) { return move->fixMeshCompare(&mesh); });
}

/// First in strides over which a velocity changes by some hundredths of the largest; where these do not reach
/// the end, turns and straight ways go on in longer ones. Those are uneven: they meet no period.
void sweep(lmp::LAMMPS* lammps, double steps, const std::function<void()>& visit)
{
  std::vector<lmp::FixMoveMesh*> moves = moves_of(lammps);
  if (moves.empty() || steps <= 0) return;
  constexpr int fine_strides = 400, long_strides = 100;
  const double dt = lammps->update->dt;
  const lmp::bigint first = lammps->update->ntimestep;
  double done = 0;
  const auto stride = [&](double length) {
    done += length;
    lammps->update->ntimestep = first + static_cast<lmp::bigint>(done);
    for (lmp::FixMoveMesh* fix : moves) move(*fix, length * dt);
    visit();
  };
  visit();
  std::vector<double> before = velocities(moves);
  double length = 1, fastest = largest(before);
  for (int k = 0; k < fine_strides && done < steps; ++k) {
    stride(std::min(length, steps - done));
    std::vector<double> now = velocities(moves);
    fastest = std::max(fastest, largest(now));
    const double change = largest_change(now, before) / std::max(fastest, std::numeric_limits<double>::min());
    if (change < 0.015) length = std::min(2 * length, std::max(1.0, std::floor(steps / long_strides)));
    if (change > 0.05) length = std::max(1.0, std::floor(length / 2));
    before = std::move(now);
  }
  std::erase_if(moves, [](lmp::FixMoveMesh* fix) { return !takes_any_stride(*fix); });
  const double rest = (steps - done) / long_strides;
  for (int k = 0; k < long_strides && rest > 0 && !moves.empty(); ++k)
    stride(k + 1 < long_strides ? rest * (0.75 + 0.5 * std::fmod(0.618 * k, 1.0))
                                : std::max(0.0, steps - done));
  lammps->update->ntimestep = first;
}

}  // namespace plan
}  // namespace granulaw::plugin
