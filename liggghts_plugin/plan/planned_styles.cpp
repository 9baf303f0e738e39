#include "liggghts_plugin/engine/private_members.hpp"
#include "liggghts_plugin/loop/command.hpp"
#include "liggghts_plugin/plan/dry_run.hpp"
#include "liggghts_plugin/plan/planner.hpp"

namespace granulaw::plugin {

namespace {

using PairFactory = LIGGGHTS::Utils::AbstractFactory<LIGGGHTS::PairStyles::IGranularPairStyle>;
using WallFactory = LIGGGHTS::Utils::AbstractFactory<LIGGGHTS::Walls::IGranularWall>;

}  // namespace

GRANULAW_EXPOSE(NormalModels, cm::Factory, normal_models);
GRANULAW_EXPOSE(PairStyles, PairFactory, styleTable);
GRANULAW_EXPOSE(WallStyles, WallFactory, styleTable);

namespace plan {

namespace {

namespace lg = LIGGGHTS;

/// A command with a model of ours: its words are read and checked.
class PlannedCommand final : public CommandStyle
{
 public:
  PlannedCommand(LAMMPS* lmp, FixWallGran* wall) : CommandStyle(lmp, wall) {}
  void each_open(const std::function<void(const OpenContact&)>&) const override {}
  const Options& read(const ModelInfo& model, std::int64_t hash, int nargs, char** args)
  {
    plan(model, hash, nargs, args);
    return setup().options;
  }
};

std::string name_of(int normal)
{
  for (const auto& [name, id] : cm::Factory::instance().*exposed(NormalModels{}))
    if (id == normal) return name;
  return "off";
}

/// Hands the words of the command to the planner; those of LIGGGHTS's own models have no bearing on a plan.
void note(LAMMPS* lmp, FixWallGran* wall, std::int64_t hash, int nargs, char** args,
          std::unique_ptr<PlannedCommand>& command)
{
  const int normal = ModelIds::of(hash).normal;
  const ModelInfo* ours = find_model(normal);
  if (!ours) return Planner::current()->note_style(wall, name_of(normal), {});
  command = std::make_unique<PlannedCommand>(lmp, wall);
  Planner::current()->note_style(wall, ours->name, command->read(*ours, hash, nargs, args));
}

/// pair_style gran without forces.
class PlannedPair final : public lg::PairStyles::IGranularPairStyle
{
 public:
  PlannedPair(LAMMPS* lmp, std::int64_t hash) : lmp_(lmp), hash_(hash) {}
  void settings(int nargs, char** args, lg::IContactHistorySetup*) override
  {
    note(lmp_, nullptr, hash_, nargs, args, command_);
  }
  void init_granular() override
  {
    if (command_) provide_stats_fix(lmp_);
  }
  void write_restart_settings(FILE* file) override { std::fwrite(&hash_, sizeof hash_, 1, file); }
  void read_restart_settings(FILE* file, std::int64_t) override
  {
    std::int64_t ignored;
    if (lmp_->comm->me == 0 && std::fread(&ignored, sizeof ignored, 1, file) != 1)
      lmp_->error->all(FLERR, "the restart file ends within its pair style");
  }
  /// No force; the arrays of stress and energy must be there.
  void compute_force(PairGran* pair, int eflag, int vflag, int) override
  {
    if (eflag || vflag)
      pair->ev_setup(eflag, vflag);
    else
      pair->evflag = pair->vflag_fdotr = 0;
  }
  int get_history_offset(const std::string) override { return 0; }
  double stressStrainExponent() override { return 1.5; }
  std::int64_t hashcode() override { return hash_; }
  bool contact_match(const std::string, const std::string) override { return true; }

 private:
  LAMMPS* lmp_;
  std::int64_t hash_;
  std::unique_ptr<PlannedCommand> command_;
};

/// fix wall/gran without forces.
class PlannedWall final : public lg::Walls::IGranularWall
{
 public:
  PlannedWall(LAMMPS* lmp, FixWallGran* parent, std::int64_t hash) : lmp_(lmp), parent_(parent), hash_(hash)
  {
  }
  ~PlannedWall() override { Planner::current()->forget_style(parent_); }
  void settings(int nargs, char** args, lg::IContactHistorySetup*) override
  {
    note(lmp_, parent_, hash_, nargs, args, command_);
  }
  void init_granular() override {}
  bool checkSurfaceIntersect(cm::SurfacesIntersectData&) override { return false; }
  void compute_force(FixWallGran*, cm::SurfacesIntersectData&, bool, double*, LAMMPS_NS::FixMeshSurface*, int,
                     LAMMPS_NS::TriMesh*, int) override
  {
  }
  int get_history_offset(const std::string) override { return 0; }
  bool contact_match(const std::string, const std::string) override { return true; }

 private:
  LAMMPS* lmp_;
  FixWallGran* parent_;
  std::int64_t hash_;
  std::unique_ptr<PlannedCommand> command_;
};

lg::PairStyles::IGranularPairStyle* make_pair(LAMMPS* lmp, PairGran*, std::int64_t hash)
{
  return new PlannedPair(lmp, hash);
}

lg::Walls::IGranularWall* make_wall(LAMMPS* lmp, FixWallGran* parent, std::int64_t hash)
{
  return new PlannedWall(lmp, parent, hash);
}

}  // namespace

void replace_contacts()
{
  // combinations that are not in the table take the creator of one that is
  for (auto& [key, create] : lg::PairStyles::Factory::instance().*exposed(PairStyles{})) create = &make_pair;
  for (auto& [key, create] : lg::Walls::Factory::instance().*exposed(WallStyles{})) create = &make_wall;
}

}  // namespace plan
}  // namespace granulaw::plugin
