#include "liggghts_plugin/plan/planner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <set>

#include "fix_gravity.h"
#include "fix_insert_pack.h"
#include "fix_insert_rate_region.h"
#include "fix_property_global.h"
#include "fix_template_sphere.h"
#include "input.h"
#include "mesh_module_stress_servo.h"
#include "liggghts_plugin/contact/thornton_physics.hpp"
#include "liggghts_plugin/deck/options.hpp"
#include "liggghts_plugin/deck/session.hpp"
#include "liggghts_plugin/engine/fix_style.hpp"
#include "liggghts_plugin/engine/private_members.hpp"
#include "liggghts_plugin/plan/dry_run.hpp"
#include "liggghts_plugin/plan/geometry.hpp"
#include "liggghts_plugin/plan/result_file.hpp"
#include "liggghts_plugin/plan/sweep.hpp"
#include "primitive_wall.h"
#include "region.h"

namespace granulaw::plugin {

GRANULAW_EXPOSE(InputCommand, LAMMPS_NS::Input, command);
GRANULAW_EXPOSE(WrittenStyles, LAMMPS_NS::Modify, style_restart_global);
GRANULAW_EXPOSE(SoughtLabel, LAMMPS_NS::Input, label_active);
GRANULAW_EXPOSE(PropertyName, LAMMPS_NS::FixPropertyGlobal, variablename);
GRANULAW_EXPOSE(PropertyCount, LAMMPS_NS::FixPropertyGlobal, nvalues);
GRANULAW_EXPOSE(PrimitiveType, LAMMPS_NS::PrimitiveWall, wType);
GRANULAW_EXPOSE(PrimitiveNumbers, LAMMPS_NS::PrimitiveWall, param);
GRANULAW_EXPOSE(IsSheared, LAMMPS_NS::FixWallGran, shear_);
GRANULAW_EXPOSE(ShearSpeed, LAMMPS_NS::FixWallGran, vshear_);
GRANULAW_EXPOSE(ShearDimension, LAMMPS_NS::FixWallGran, shearDim_);
GRANULAW_EXPOSE(ShearAxis, LAMMPS_NS::FixWallGran, shearAxis_);
GRANULAW_EXPOSE(HasTotal, LAMMPS_NS::FixInsert, ninsert_exists);
GRANULAW_EXPOSE(InsertionTotal, LAMMPS_NS::FixInsert, ninsert);
GRANULAW_EXPOSE(Inserted, LAMMPS_NS::FixInsert, ninserted);
GRANULAW_EXPOSE(EachInsertion, LAMMPS_NS::FixInsert, ninsert_per);
GRANULAW_EXPOSE(AllIn, LAMMPS_NS::FixInsert, all_in_flag);
GRANULAW_EXPOSE(VelocityStyle, LAMMPS_NS::FixInsert, v_randomSetting);
GRANULAW_EXPOSE(MeanVelocity, LAMMPS_NS::FixInsert, v_insert);
GRANULAW_EXPOSE(VelocitySpread, LAMMPS_NS::FixInsert, v_insertFluct);
GRANULAW_EXPOSE(PackRegion, LAMMPS_NS::FixInsertPack, ins_region);
GRANULAW_EXPOSE(PackVolume, LAMMPS_NS::FixInsertPack, region_volume);
GRANULAW_EXPOSE(PackFraction, LAMMPS_NS::FixInsertPack, volumefraction_region);
GRANULAW_EXPOSE(PackNumber, LAMMPS_NS::FixInsertPack, ntotal_region);
GRANULAW_EXPOSE(PackMass, LAMMPS_NS::FixInsertPack, masstotal_region);
GRANULAW_EXPOSE(NumberShares, LAMMPS_NS::FixParticledistributionDiscrete, distweight);
GRANULAW_EXPOSE(ServoSpeed, LAMMPS_NS::MeshModuleStressServo, vel_max_);
GRANULAW_EXPOSE(TemplateDensity, LAMMPS_NS::FixTemplateSphere, pdf_density);

namespace plan {

namespace {

namespace lmp = LAMMPS_NS;

Planner* planner = nullptr;

using deck::ball_volume, deck::dot, deck::norm;

/// Part of a motion that may go against gravity where the deck rounds its numbers.
constexpr double level = 1e-3;

bool begins(const char* text, const char* with)
{
  return std::strncmp(text, with, std::strlen(with)) == 0;
}

/// Particles of one insertion, before any limit on the total.
double each_insertion(lmp::FixInsert& fix)
{
  auto* pack = dynamic_cast<lmp::FixInsertPack*>(&fix);
  if (!pack || dynamic_cast<lmp::FixInsertRateRegion*>(&fix)) return fix.*exposed(EachInsertion{});
  lmp::FixParticledistributionDiscrete& mixture = *fix.get_distribution();
  if (const double fraction = pack->*exposed(PackFraction{}); fraction > 0)
    return fraction * (pack->*exposed(PackVolume{})) / mixture.vol_expect();
  if (const int number = pack->*exposed(PackNumber{}); number > 0) return number;
  return pack->*exposed(PackMass{}) / mixture.mass_expect();
}

/// Gaussian to three sigma.
double largest_speed(lmp::FixInsert& fix)
{
  const int style = fix.*exposed(VelocityStyle{});
  const double wide = style == RANDOM_CONSTANT ? 0 : style == RANDOM_UNIFORM ? 1 : 3;
  const auto& mean = fix.*exposed(MeanVelocity{});
  const auto& spread = fix.*exposed(VelocitySpread{});
  std::array<double, 3> most;
  for (std::size_t k = 0; k < 3; ++k) most[k] = std::abs(mean[k]) + wide * std::abs(spread[k]);
  return norm(most);
}

Box place_of(lmp::FixInsert& fix, const Box& domain)
{
  Box box = domain;
  if (auto* pack = dynamic_cast<lmp::FixInsertPack*>(&fix)) {
    const lmp::Region& region = *(pack->*exposed(PackRegion{}));
    if (!region.bboxflag) return domain;
    box.low = {region.extent_xlo, region.extent_ylo, region.extent_zlo};
    box.high = {region.extent_xhi, region.extent_yhi, region.extent_zhi};
    return box.within(domain);
  }
  if (auto* stream = dynamic_cast<lmp::FixInsertStream*>(&fix); stream && stream->face())
    stream->face()->getGlobalBoundingBox().getBoxBounds(box.low.data(), box.high.data());
  return box;
}

/// Density of a template's spheres: the largest; of a clump that of its smallest sphere with the body's mass.
double density_of(lmp::FixTemplateSphere& t)
{
  if (t.number_spheres() > 1) return t.massexpect() / ball_volume(t.min_rad());
  return LMP_PROBABILITY_NS::pdf_max(t.*exposed(TemplateDensity{}));
}

void include_radius(Source& s, double radius)
{
  s.radius_min = s.radius_max > 0 ? std::min(s.radius_min, radius) : radius;
  s.radius_max = std::max(s.radius_max, radius);
}

}  // namespace

Planner::Planner(lmp::LAMMPS* lammps, std::string file) : lmp_(lammps), file_(std::move(file))
{
  planner = this;
  is_planning = true;
  replace_contacts();
  replace_styles(lmp_);
}

Planner* Planner::current()
{
  return planner;
}

template <class Visit>
void Planner::each_fix(Visit&& visit) const
{
  for (int f = 0; f < lmp_->modify->nfix; ++f) visit(*lmp_->modify->fix[f]);
}

std::string Planner::where(const lmp::Fix& fix) const
{
  const auto found = places_.find(&fix);
  return found == places_.end() ? where_ : found->second.second;
}

void Planner::note_style(const lmp::FixWallGran* wall_fix, const std::string& model, const Options& options)
{
  if (wall_fix) {
    styles_[wall_fix] = {model, options.deformable_wall};
    if (model == "mpm" && record_.model.empty() && options.own_words("law").empty())
      record_.note(where_ + ": the wall stands before its pair_style: put it behind");
    return;
  }
  record_.model = model;
  record_.stretch = options.stretch.value_or(1.0);
  const auto& law = options.own_words("law");
  record_.law_file = law.empty() ? "" : law[0];
  record_.material_names = options.own_words("materials");
  const auto& confinement = options.own_words("confinement");
  record_.confinement = confinement.empty() || confinement[0] == "off" ? "" : confinement[0];
  record_.yield_pressure = yield_pressure_of(options);
}

void Planner::begin_line(const std::string& where, const std::string& text)
{
  record_command();
  after_command();
  drop_written_histories();
  stop_where_late();
  where_ = where;
  Record stopped;
  stopped.stopped_at = where;
  crash_ = stopped.json();
  loops_.pass_on();
  if ((lmp_->input->*exposed(SoughtLabel{})) != 0) return;  // a jump goes past it
  if (const std::string value = run_value_of_branch(lmp_->input->variable, text); !value.empty())
    begin_branch(value, text.find("jump") != std::string::npos);
}

void Planner::begin_branch(const std::string& value, bool jumps)
{
  const std::string branch = where_ + ": the branch depends on a value of a run: it takes the side of the start";
  if (!jumps) return record_.note(branch);
  record_.left_loop = where_;
  if (!loops_.arrive(where_, record_.runs.size(), places_now())) {
    if (!loops_.inside()) record_.note(branch);
    return;
  }
  std::erase(record_.notes, branch);
  record_.note(fmt::format("{}: the loop waits for {}, which only a simulation has: the plan leaves it where its meshes have "
                           "passed the particles or nothing new comes",
                           where_, value));
}

WaitingLoops::Places Planner::places_now() const
{
  WaitingLoops::Places places;
  each_fix([&](lmp::Fix& fix) {
    auto* mesh = dynamic_cast<lmp::FixMeshSurface*>(&fix);
    if (mesh && is_moved(lmp_, *mesh)) places.meshes[mesh->id] = look_at(*mesh).box;
  });
  for (int i = 0; i < lmp_->atom->nlocal; ++i) places.centres.include(Box::Point{lmp_->atom->x[i][0], lmp_->atom->x[i][1], lmp_->atom->x[i][2]});
  return places;
}

/// The last one: LIGGGHTS's words of it stand until it parses the next line.
void Planner::record_command()
{
  const char* command = lmp_->input->*exposed(InputCommand{});
  if (!command || where_.empty() || (lmp_->input->*exposed(SoughtLabel{})) != 0) return;
  std::vector<std::string> words{command};
  words.insert(words.end(), lmp_->input->arg, lmp_->input->arg + lmp_->input->narg);
  record_.add_command(where_, std::move(words));
}

/// A restart file's histories of contacts: planned walls keep none.
void Planner::drop_written_histories()
{
  lmp::Modify& modify = *lmp_->modify;
  for (int k = 0; k < modify.nfix_restart_global; ++k)
    if (begins((modify.*exposed(WrittenStyles{}))[k], "contacthistory")) (modify.*exposed(WrittenStyles{}))[k][0] = '\0';
}

void Planner::after_command()
{
  std::map<const lmp::Fix*, std::pair<std::string, std::string>> now;
  each_fix([&](const lmp::Fix& fix) {
    const auto known = places_.find(&fix);
    const bool same = known != places_.end() && known->second.first == fix.id;
    now[&fix] = {fix.id, same ? known->second.second : where_};
  });
  places_ = std::move(now);
  replace_styles(lmp_);  // run_style, clear
  record_.units = lmp_->update->unit_style;
  record_.types = std::max(record_.types, lmp_->atom->ntypes);
  const lmp::Domain& domain = *lmp_->domain;
  record_.dimension = domain.dimension;
  if (!domain.box_exist) {  // not yet, or `clear`
    atoms_.clear();
    cleared_ = record_.count();
    has_box_ = false;
  } else if (!has_box_) {
    record_.domain.include(Box::Point{domain.boxlo[0], domain.boxlo[1], domain.boxlo[2]});
    record_.domain.include(Box::Point{domain.boxhi[0], domain.boxhi[1], domain.boxhi[2]});
    has_box_ = true;
  }
  if (lmp_->atom->natoms != natoms_) atoms_where_ = where_;
  natoms_ = static_cast<lmp::bigint>(lmp_->atom->natoms);
}

void Planner::begin_run()
{
  record_command();  // the commands that it repeats (run ... every) stand in its place behind it
  after_command();
  const auto& written = Session::of(lmp_)->restarted;
  if (const auto pair = written.find(pairs_record); pair != written.end())
    record_.restart_stretch = pair->second.stretch;
  find_settings();
  find_materials();
  find_walls();
  find_forces();
  find_atoms();
  find_insertions();
  count_ = record_.count() - cleared_;
}

/// A deck without a run, for a program that drives LIGGGHTS: what stands there when it ends, and the
/// templates that the program may insert.
void Planner::record_without_run()
{
  if (!record_.runs.empty() || !lmp_->domain->box_exist) return;
  each_fix([](lmp::Fix& fix) {
    if (auto* gravity = dynamic_cast<lmp::FixGravity*>(&fix)) gravity->init();  // it has no value before
  });
  begin_run();
  if (!record_.sources.empty()) return;
  each_fix([&](lmp::Fix& fix) {
    auto* t = dynamic_cast<lmp::FixTemplateSphere*>(&fix);
    if (!t) return;
    for (int type = t->mintype(); type <= t->maxtype(); ++type)
      record_.sources.push_back({where(fix), type, t->min_rad(), t->max_rad(), density_of(*t), {}, 0, 0});
  });
}

void Planner::find_settings()
{
  for (std::size_t k = 0; k < 3; ++k) record_.periodic[k] = lmp_->domain->periodicity[k] != 0;
  record_.time_step = lmp_->update->dt;
  if (lmp_->atom->superquadric_flag)
    record_.unknown_particles = {"atom_style superquadric: only spheres are understood"};
  each_fix([&](lmp::Fix& fix) {
    if (auto* gravity = dynamic_cast<lmp::FixGravity*>(&fix)) gravity->get_gravity(record_.gravity.data());
  });
}

void Planner::find_materials()
{
  each_fix([&](lmp::Fix& fix) {
    auto* property = dynamic_cast<lmp::FixPropertyGlobal*>(&fix);
    if (!property) return;
    const std::string name = property->*exposed(PropertyName{});
    const int count = property->*exposed(PropertyCount{});
    const double* values = property->get_values();
    if (!values) return;
    if (name == "coefficientRestitution") {
      for (int k = 0; k < count; ++k)
        record_.restitution = std::min(values[k], record_.restitution.value_or(1.0));
      return;
    }
    if (name == "coefficientFriction") record_.friction.assign(values, values + count);
    for (int k = 0; k < std::min(count, lmp_->atom->ntypes); ++k) {
      if (name == "youngsModulus" || name == "YoungsModulus")
        record_.materials[k + 1].youngs_modulus = values[k];
      if (name == "poissonsRatio") record_.materials[k + 1].poisson_ratio = values[k];
      if (name == "yieldStress") record_.materials[k + 1].yield_stress = values[k];
    }
  });
}

/// Against gravity; 0 without gravity.
Box::Point Planner::upward() const
{
  const double g = norm(record_.gravity);
  if (g == 0) return {};
  return {-record_.gravity[0] / g, -record_.gravity[1] / g, -record_.gravity[2] / g};
}

Wall& Planner::wall(const std::string& where, const std::string& id)
{
  for (Wall& w : record_.walls)
    if (w.id == id && w.where == where) return w;
  record_.walls.emplace_back();
  record_.walls.back().where = where;
  record_.walls.back().id = id;
  return record_.walls.back();
}

void Planner::find_walls()
{
  each_fix([&](lmp::Fix& fix) {
    auto* gran = dynamic_cast<lmp::FixWallGran*>(&fix);
    if (!gran) {
      if (begins(fix.style, "wall/"))
        record_.note(
            fmt::format("{}: 'fix {}' is not planned with: only wall/gran is", where(fix), fix.style));
      return;
    }
    if (!gran->is_mesh_wall()) return add_primitive_wall(*gran);
    for (int m = 0; m < gran->n_meshes(); ++m) add_mesh_wall(*gran, *gran->mesh_list()[m]);
  });
  look_at_meshes(false);
}

void Planner::add_mesh_wall(const lmp::FixWallGran& fix, lmp::FixMeshSurface& mesh)
{
  Wall& w = wall(where(mesh), mesh.id);
  const Style& style = styles_[&fix];
  w.type = mesh.atomTypeWall();
  w.model = style.model;
  w.deformable = style.deformable;
  if (std::strstr(mesh.style, "servo") || std::strstr(mesh.style, "6dof"))
    record_.ask_speed(fmt::format("{}: fix {}: forces move the mesh", w.where, mesh.style));
  if (auto* servo = dynamic_cast<lmp::MeshModuleStressServo*>(mesh.get_module("servo")))
    w.speed = w.push_speed = std::max(w.speed, servo->*exposed(ServoSpeed{}));
}

void Planner::add_primitive_wall(lmp::FixWallGran& fix)
{
  using namespace LAMMPS_NS::PRIMITIVE_WALL_DEFINITIONS;
  Wall& w = wall(where(fix), fix.id);
  const Style& style = styles_[&fix];
  w.type = fix.atom_type_wall();
  w.model = style.model;
  w.deformable = style.deformable;
  w.box = record_.domain;
  const int shape = fix.primitiveWall()->*exposed(PrimitiveType{});
  const double* numbers = fix.primitiveWall()->*exposed(PrimitiveNumbers{});
  if (shape <= ZPLANE) {
    const auto axis = static_cast<std::size_t>(shape - XPLANE);
    w.box.low[axis] = w.box.high[axis] = numbers[0];
  } else {
    const auto axis = static_cast<std::size_t>(shape - XCYLINDER);
    for (std::size_t k = 0, centre = 1; k < 3; ++k) {
      if (k == axis) continue;
      w.box.low[k] = numbers[centre] - numbers[0];
      w.box.high[k] = numbers[centre] + numbers[0];
      ++centre;
    }
  }
  if (!(fix.*exposed(IsSheared{}))) return;
  // shear of a cylinder across its axis is a turn, in rad per time
  const bool turns = shape > ZPLANE && fix.*exposed(ShearAxis{}) >= 0;
  w.drag_speed = std::max(w.drag_speed, std::abs(fix.*exposed(ShearSpeed{})) * (turns ? numbers[0] : 1.0));
  // what it drags against gravity it may carry to its top
  const Box::Point up = upward();
  const double aside = turns ? std::sqrt(std::max(0.0, 1 - std::pow(up[static_cast<std::size_t>(shape - XCYLINDER)], 2)))
                             : std::abs(up[static_cast<std::size_t>(fix.*exposed(ShearDimension{}))]);
  if (aside > level) w.lift = w.box.top(up) - w.box.bottom(up);
}

void Planner::look_at_meshes(bool moving)
{
  each_fix([&](lmp::Fix& fix) {
    auto* gran = dynamic_cast<lmp::FixWallGran*>(&fix);
    if (!gran || !gran->is_mesh_wall()) return;
    for (int m = 0; m < gran->n_meshes(); ++m) {
      lmp::FixMeshSurface& mesh = *gran->mesh_list()[m];
      Wall& w = wall(where(mesh), mesh.id);
      const MeshView view = look_at(mesh);
      w.box.include(view.box);
      const bool drags = mesh.surfaceVel();
      if (!drags && !(moving && is_moved(lmp_, mesh))) continue;
      MeshMotion& motion = motions_[w.where + " " + w.id];
      motion.look(view.corners, view.velocities, upward());
      if (drags) {
        w.drag_speed = std::max(w.drag_speed, motion.speed());
        const Box::Point up = upward();
        for (const auto& triangle : view.velocities)
          if (norm(up) > 0 && std::abs(dot(triangle[0], up)) > level * motion.speed()) w.lift = w.box.top(up) - w.box.bottom(up);
        continue;
      }
      w.speed = std::max(w.speed, motion.speed());
      w.push_speed = std::max(w.push_speed, motion.push_speed());
      w.level_push_speed = std::max(w.level_push_speed, motion.level_push_speed());
      w.lift = std::max(w.lift, motion.lift());
    }
  });
}

void Planner::move_meshes(double steps)
{
  sweep(lmp_, steps * loops_.stride(), [&] { look_at_meshes(true); });
}

/// Fixes that give velocities which no first step shows.
void Planner::find_forces()
{
  static constexpr const char* styles[] = {"addforce", "aveforce",  "couple/",  "drag",   "efield",
                                           "external", "nve/limit", "setforce", "spring", "rigid"};
  each_fix([&](const lmp::Fix& fix) {
    const bool moves = std::strcmp(fix.style, "move") == 0;
    for (const char* style : styles)
      if (begins(fix.style, style)) {
        if (begins(fix.style, "rigid"))
          record_.note(fmt::format("{}: fix {}: each sphere is planned with its own mass, not the body's",
                                   where(fix), fix.style));
        else
          record_.ask_speed(fmt::format("{}: fix {} changes velocities", where(fix), fix.style));
        return;
      }
    if (moves) record_.ask_speed(fmt::format("{}: fix {} changes velocities", where(fix), fix.style));
  });
}

Planner::Atom Planner::atom(int i) const
{
  const lmp::Atom& a = *lmp_->atom;
  Atom result{a.type[i], a.radius[i], a.rmass[i] / ball_volume(a.radius[i]), {}, {}};
  std::copy_n(a.x[i], 3, result.x.begin());
  std::copy_n(a.v[i], 3, result.v.begin());
  return result;
}

/// Particles that commands brought in, or changed, since the last run.
void Planner::find_atoms()
{
  const lmp::Atom& a = *lmp_->atom;
  if (!a.radius || !a.rmass) return;
  std::map<int, std::size_t> fresh;  // source by type
  for (int i = 0; i < a.nlocal; ++i) {
    const Atom now = atom(i);
    const auto known = atoms_.find(a.tag[i]);
    if (known != atoms_.end()) {
      const Atom& old = known->second;
      const bool moved = now.x != old.x, changed = now.radius != old.radius || now.density != old.density;
      if (!moved && !changed && now.v == old.v && now.type == old.type) continue;
      bool found = false;
      for (Source& s : record_.sources) {
        if (s.type != now.type) continue;
        found = true;
        include_radius(s, now.radius);
        s.density = std::max(s.density, now.density);
        if (now.v != old.v) s.speed = std::max(s.speed, norm(now.v));
        if (moved) s.centres.include(now.x);
      }
      if (found) continue;
    }
    const auto [at, is_new] = fresh.try_emplace(now.type, record_.sources.size());
    if (is_new) {
      record_.sources.emplace_back();
      record_.sources.back().where = atoms_where_;
      record_.sources.back().type = now.type;
    }
    Source& s = record_.sources[at->second];
    include_radius(s, now.radius);
    s.density = std::max(s.density, now.density);
    s.centres.include(now.x);
    s.speed = std::max(s.speed, norm(now.v));
    if (known == atoms_.end()) s.count += 1;  // else its type is new, and it was counted
  }
  atoms_.clear();
  for (int i = 0; i < a.nlocal; ++i) atoms_[a.tag[i]] = atom(i);
}

Planner::Insertion& Planner::insertion_of(lmp::FixInsert& fix)
{
  const std::string place = where(fix);
  const auto [found, is_new] = insertions_.try_emplace(place + " " + fix.id);
  Insertion& in = found->second;
  if (!is_new) return in;
  lmp::FixParticledistributionDiscrete& mixture = *fix.get_distribution();
  in.spheres = 0;
  for (int k = 0; k < mixture.n_particletemplates(); ++k) {
    lmp::FixTemplateSphere& t = *mixture.particletemplates()[k];
    const double share = (mixture.*exposed(NumberShares{}))[k] * t.number_spheres();
    in.spheres += share;
    for (int type = t.mintype(); type <= t.maxtype(); ++type) {
      Source s;
      s.where = place;
      s.type = type;
      s.radius_min = t.min_rad();
      s.radius_max = t.max_rad();
      s.density = density_of(t);
      s.centres = place_of(fix, record_.domain);
      if (fix.*exposed(AllIn{})) s.centres = s.centres.shrunk(t.number_spheres() > 1 ? 0.0 : t.min_rad());
      s.speed = largest_speed(fix);
      in.sources.push_back(record_.sources.size());
      in.shares.push_back(share / (t.maxtype() - t.mintype() + 1));
      record_.sources.push_back(s);
    }
  }
  for (double& share : in.shares) share /= in.spheres;
  return in;
}

void Planner::find_insertions()
{
  each_fix([&](lmp::Fix& fix) {
    auto* insert = dynamic_cast<lmp::FixInsert*>(&fix);
    if (!insert) return;
    Insertion& in = insertion_of(*insert);
    in.before = insert->*exposed(Inserted{});
    in.next = insert->next_reneighbor;
  });
}

double Planner::filled() const
{
  const lmp::Domain& domain = *lmp_->domain;
  std::array<std::set<double>, 3> planes;
  double room = 1;
  each_fix([&](lmp::Fix& fix) {
    auto* gran = dynamic_cast<lmp::FixWallGran*>(&fix);
    if (!gran) return;
    if (!gran->is_mesh_wall()) {
      using namespace LAMMPS_NS::PRIMITIVE_WALL_DEFINITIONS;
      const int shape = gran->primitiveWall()->*exposed(PrimitiveType{});
      const double* numbers = gran->primitiveWall()->*exposed(PrimitiveNumbers{});
      const auto axis = static_cast<std::size_t>(shape <= ZPLANE ? shape - XPLANE : shape - XCYLINDER);
      if (shape <= ZPLANE) planes[axis].insert(numbers[0]);
      for (std::size_t k = 0, centre = 1; shape > ZPLANE && k < 3; ++k)
        if (k != axis) planes[k].insert({numbers[centre] - numbers[0], numbers[centre] + numbers[0]}), ++centre;
      if (shape > ZPLANE) room = M_PI / 4;
      return;
    }
    for (int m = 0; m < gran->n_meshes(); ++m) {
      const Box box = look_at(*gran->mesh_list()[m]).box;
      const auto width = [&](std::size_t k) { return box.high[k] - box.low[k]; };
      for (std::size_t k = 0; k < 3; ++k)
        if (width(k) < 1e-6 * std::max({width(0), width(1), width(2)})) planes[k].insert(box.low[k]);
    }
  });
  for (std::size_t k = 0; k < 3; ++k) {
    if (domain.periodicity[k])
      room *= domain.boxhi[k] - domain.boxlo[k];
    else if (planes[k].size() == 2)
      room *= *planes[k].rbegin() - *planes[k].begin();
    else
      return 0;
  }
  double solid = 0;
  for (const Source& s : record_.sources) solid += s.count * 0.5 * (ball_volume(s.radius_min) + ball_volume(s.radius_max));
  return room > 0 ? solid / room : 0;
}

/// In the dry run's second step nothing is inserted: it stands for the run's last.
void Planner::hold_insertions()
{
  each_fix([&](lmp::Fix& fix) {
    if (dynamic_cast<lmp::FixInsert*>(&fix)) fix.next_reneighbor = 0;
  });
}

void Planner::end_run(int steps)
{
  const lmp::bigint last = lmp_->update->ntimestep, first = last - steps;
  each_fix([&](lmp::Fix& fix) {
    auto* insert = dynamic_cast<lmp::FixInsert*>(&fix);
    if (!insert) return;
    Insertion& in = insertion_of(*insert);
    insert->next_reneighbor = in.next;
    if (in.next <= first || in.next > last) return;
    const int every = insert->ins_every();
    const lmp::bigint times = every > 0 ? (last - in.next) / every + 1 : 1;
    const double each = each_insertion(*insert);
    int& inserted = insert->*exposed(Inserted{});
    double added = each * static_cast<double>(times);
    const bool fills =
        dynamic_cast<lmp::FixInsertPack*>(insert) && !dynamic_cast<lmp::FixInsertRateRegion*>(insert);
    if (fills && !in.began && in.next == first + 1) added += (inserted - in.before) - each;
    const bool limited = (insert->*exposed(HasTotal{})) != 0;
    if (limited)
      added = std::min(added, static_cast<double>((insert->*exposed(InsertionTotal{})) - in.before));
    in.began = true;
    inserted = in.before + static_cast<int>(std::min(std::round(added), 1e9));
    const bool ended = every <= 0 || (limited && inserted >= (insert->*exposed(InsertionTotal{})));
    insert->next_reneighbor = ended ? 0 : in.next + times * every;
    for (std::size_t k = 0; k < in.sources.size(); ++k)
      record_.sources[in.sources[k]].count += added * in.spheres * in.shares[k];
  });
  bool closes = false;
  each_fix([&](lmp::Fix& fix) {
    auto* mesh = dynamic_cast<lmp::FixMeshSurface*>(&fix);
    closes |= begins(fix.style, "deform") || (mesh && (is_moved(lmp_, *mesh) || mesh->get_module("servo")));
  });
  if (closes && cleared_ == 0) record_.solid_volume = std::max(record_.solid_volume, filled());
  // what fixes changed while it ran
  const lmp::Atom& a = *lmp_->atom;
  for (int i = 0; a.radius && a.rmass && i < a.nlocal; ++i) {
    const Atom now = atom(i);
    const auto [known, is_new] = atoms_.try_emplace(a.tag[i], now);
    Atom& old = known->second;
    if (!is_new) {  // it stays: nothing holds it
      std::copy_n(old.x.begin(), 3, a.x[i]);
      std::copy_n(old.v.begin(), 3, a.v[i]);
    }
    if (now.radius != old.radius || now.type != old.type)
      for (Source& s : record_.sources)
        if (s.type == now.type) {
          include_radius(s, now.radius);
          s.density = std::max(s.density, now.density);
        }
    old = atom(i);
  }
  natoms_ = static_cast<lmp::bigint>(a.natoms);
}

void Planner::add_run(int steps)
{
  record_.runs.push_back(
      {where_, static_cast<double>(steps), lmp_->update->dt, 0.5 * (count_ + record_.count() - cleared_), moves_particles(*lmp_->modify)});
  stop_where_nothing_is_new();
  stop_where_late();
}

void Planner::stop_where_nothing_is_new()
{
  constexpr int most_runs = 1000;
  std::vector<double> now = record_.fingerprint();
  runs_without_news_ = now == fingerprint_ ? runs_without_news_ + 1 : 0;
  fingerprint_ = std::move(now);
  if (runs_without_news_ < most_runs) return;
  if (loops_.inside()) {
    runs_without_news_ = 0;
    return loops_.find_nothing_new();
  }
  record_.left_loop = where_;
  record_.note(fmt::format(
      "{}: {} runs in turn bring nothing new: the plan leaves the loop and the deck here, and its "
      "cost counts the runs up to here",
      where_, most_runs));
  std::exit(0);
}

void Planner::stop_where_late()
{
  constexpr std::chrono::seconds longest{60};
  if (std::chrono::steady_clock::now() - start_ < longest) return;
  record_.note(fmt::format(
      "{}: reading the deck takes more than {} s: the plan leaves it here, and its cost counts the "
      "runs up to here",
      where_, longest.count()));
  std::exit(0);
}

bool Planner::finish(int status)
{
  // `quit` ends as an error does
  const char* command = status == 0 ? nullptr : lmp_->input->*exposed(InputCommand{});
  const bool ended = status == 0 || (command && std::strcmp(command, "quit") == 0);
  if (!ended && loops_.inside())
    record_.note(fmt::format("{}: LIGGGHTS stops in a loop that waits for a value of a simulation: the plan ends there", where_));
  else if (!ended)
    record_.stopped_at = where_;
  else
    record_command(), after_command(), record_without_run();
  if (write_result(file_, record_.json())) return record_.stopped_at.empty();
  std::fprintf(stderr, "ERROR: %s: cannot be written\n", file_.c_str());
  return false;
}

void Planner::note_crash() const
{
  write_result(file_, crash_);
}

}  // namespace plan
}  // namespace granulaw::plugin
