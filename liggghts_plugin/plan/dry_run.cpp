#include "liggghts_plugin/plan/dry_run.hpp"

#include <cstring>
#include <regex>
#include <set>

#include "compute_pair_gran_local.h"
#include "liggghts_plugin/engine/fix_style.hpp"
#include "liggghts_plugin/engine/private_members.hpp"
#include "liggghts_plugin/plan/planner.hpp"
#include "liggghts_plugin/run/contact_list.hpp"
#include "output.h"
#include "variable.h"

namespace granulaw::plugin {

GRANULAW_EXPOSE(VariableStyles, LAMMPS_NS::Variable, style);
GRANULAW_EXPOSE(VariableData, LAMMPS_NS::Variable, data);
GRANULAW_EXPOSE(NextThermo, LAMMPS_NS::Output, next_thermo);

namespace plan {

void DryRun::run(int steps)
{
  Planner& planner = *Planner::current();
  planner.begin_run();
  if (steps > 0) {
    const LAMMPS_NS::bigint last = update->ntimestep + steps;
    Verlet::run(1);
    if (steps > 1) {
      planner.hold_insertions();
      planner.move_meshes(steps - 2);
      update->ntimestep = last - 1;
      // the values that the deck requires behind the run are of its last step
      output->next = output->*exposed(NextThermo{}) = last;
      modify->addstep_compute_all(last);
      Verlet::run(1);
    } else {
      planner.move_meshes(0);
    }
    planner.end_run(steps);
  }
  planner.add_run(steps);
}

namespace {

/// In place of a fix that reads the histories of contacts.
class NoFix final : public LAMMPS_NS::Fix
{
 public:
  using Fix::Fix;
  int setmask() override { return 0; }
};

LAMMPS_NS::Fix* make_no_fix(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg)
{
  return new NoFix(lmp, narg, arg);
}

/// In place of a list of contacts, for all that takes one: none, of as many columns as a deck may ask for.
class NoContacts final : public LAMMPS_NS::ComputePairGranLocal
{
 public:
  NoContacts(LAMMPS_NS::LAMMPS* lmp, int iarg, int narg, char** arg) : ComputePairGranLocal(lmp, iarg, narg, arg)
  {
    size_local_rows = ncount = ncount_added_via_pair = 0;
    size_local_cols = nvalues = 100;
    dnum = 0;
  }
  void post_create() override {}  // no pair, wall or heat fix hands it anything
  void pre_delete(bool) override {}
  void init() override {}
  void compute_local() override { invoked_local = update->ntimestep; }
};

LAMMPS_NS::Compute* make_no_contacts(LAMMPS_NS::LAMMPS* lmp, int iarg, int narg, char** arg)
{
  bool ours[3];
  std::vector<char*> words = stock_words_of_list(narg, arg, ours);
  return new NoContacts(lmp, iarg, static_cast<int>(words.size()), words.data());
}

}  // namespace

void replace_styles(LAMMPS_NS::LAMMPS* lmp)
{
  replace_fix_style(lmp, "multicontact/halfspace", &make_no_fix);
  for (const char* name : {"pair/gran/local", "wall/gran/local"})
    replace_compute_style(lmp, name, &make_no_contacts);
  LAMMPS_NS::Update& update = *lmp->update;
  if (dynamic_cast<DryRun*>(update.integrate)) return;
  delete update.integrate;
  update.integrate = new DryRun(lmp);
  delete[] update.integrate_style;
  update.integrate_style = new char[7];
  std::strcpy(update.integrate_style, "verlet");
}

namespace {

constexpr int index_style = 0;  // of an index variable: its words are as the deck wrote them

/// Thermo keywords and functions of particles. Time, step and box are no values that a run computes.
const std::regex& run_values()
{
  static const std::regex pattern(
      R"((^|[^A-Za-z0-9_])([cf]_[A-Za-z0-9_]+(\[[^\]]*\])*|(ke|pe|etotal|temp|press|enthalpy|atoms|evdwl|erot|cpu|tpcpu|spcpu|pxx|pyy|pzz)($|[^A-Za-z0-9_])|(ke|xcm|vcm|fcm|bound|gyration|angmom|count|mass)\())");
  return pattern;
}

class RunValues
{
 public:
  explicit RunValues(LAMMPS_NS::Variable* variables) : variables_(variables) {}

  /// The first one in the text; empty: there is none.
  std::string in(const std::string& text)
  {
    std::smatch own;
    if (std::regex_search(text, own, run_values())) return own[2];
    static const std::regex names(R"(\$\{([A-Za-z0-9_]+)\}|\$([A-Za-z0-9_])|v_([A-Za-z0-9_]+))");
    for (std::sregex_iterator at(text.begin(), text.end(), names), end; at != end; ++at)
      for (int group = 1; group <= 3; ++group)
        if ((*at)[group].matched)
          if (std::string of_it = of_variable((*at)[group].str()); !of_it.empty()) return of_it;
    return {};
  }

 private:
  std::string of_variable(std::string name)
  {
    if (!seen_.insert(name).second) return {};
    const int at = variables_->find(name.data());
    if (at < 0 || (variables_->*exposed(VariableStyles{}))[at] == index_style) return {};
    char** data = (variables_->*exposed(VariableData{}))[at];
    return data && data[0] ? in(data[0]) : std::string();
  }

  LAMMPS_NS::Variable* variables_;
  std::set<std::string> seen_;
};

}  // namespace

std::string run_value_of_branch(LAMMPS_NS::Variable* variables, const std::string& line)
{
  static const std::regex condition(R"(^\s*if\s+(.*?)\s+then\s)");
  std::smatch found;
  return std::regex_search(line, found, condition) ? RunValues(variables).in(found[1].str()) : std::string();
}

}  // namespace plan
}  // namespace granulaw::plugin
