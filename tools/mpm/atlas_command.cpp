// mpm atlas: computes the atlas of homogeneous materials that mpm table answers from.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "base/error.hpp"
#include "characterise/atlas_build.hpp"
#include "command.hpp"
#include "farm_options.hpp"
#include "option_checks.hpp"
#include "ranks.hpp"
#include "terminal.hpp"
#include "trace_file.hpp"

namespace granulaw {

namespace {

struct AtlasRequest
{
  std::string output;
  std::string from;      ///< an atlas whose materials stay; empty: all are run
  bool impacts = false;  ///< but their fast impacts, which are run
  int checks = 500;
  unsigned seed = 1;
  FarmOptions farm;
};

/// A part of the bar, from one share of the whole to another.
Progress part_of(ProgressBar& bar, double from, double to)
{
  return
      [&bar, from, to](double done, const std::string& what) { bar.update(from + (to - from) * done, what); };
}

/// All materials of the grid, then the fresh impacts that tell the error.
Atlas build(const AtlasRequest& r, Farm& farm)
{
  ProgressBar bar(rank() == 0);
  std::optional<Atlas> known;
  if (!r.from.empty()) known = read_atlas(r.from);
  const KnownAtlas of{known ? &*known : nullptr, r.impacts};
  const AtlasGrid grid;
  const RunSource source;
  const Atlas bare = atlas_from(grid, farm.run(atlas_jobs(grid, source, of), part_of(bar, 0, 0.8)), of);
  return {grid, bare.nodes(), bare.elastic_spheres(),
          check_atlas(bare, farm, r.checks, r.seed, part_of(bar, 0.8, 1))};
}

void make_atlas(const AtlasRequest& r)
{
  check_output(r.output, ".h5");
  const std::unique_ptr<Farm> farm = r.farm.farm();
  const Atlas atlas = build(r, *farm);
  if (rank() != 0) return;
  write_atlas(atlas, r.output);
  fmt::print("wrote {}: {} materials; {} fresh impacts: 95 % within {:.2g} % of force and {:.2g} of e\n",
             r.output, atlas.nodes().size(), atlas.checks().size(), 100 * atlas.claimed_force(),
             atlas.claimed_restitution());
  print_count(farm->count());
}

void define(CLI::App& command)
{
  const auto r = std::make_shared<AtlasRequest>();
  command.add_option("-o,--output", r->output, "atlas, NAME.h5")->required();
  CLI::Option* from =
      command.add_option("--from", r->from,
                         "an atlas whose materials stay as they are: only those that it lacks and the fresh "
                         "impacts are run");
  command
      .add_flag(
          "--impacts", r->impacts,
          "with --from: what inertia changes of its materials does not stay: their fast impacts are run "
          "(an hour of CPU time)")
      ->needs(from);
  command.add_option("--checks", r->checks, "fresh impacts of random materials that tell the atlas's error")
      ->check(whole_from_to(20, 100000))
      ->capture_default_str();
  command.add_option("--seed", r->seed, "seed of the random materials")->capture_default_str();
  r->farm.add_to(command);
  command.callback([r] { make_atlas(*r); });
}

}  // namespace

extern const Command atlas_command{
    "atlas",
    "Computes the atlas: dimensionless laws over E*/Y, Poisson's ratio, linear hardening, overlap and "
    "inertia, from\n"
    "which mpm table answers any homogeneous material at once. One comes with the program; this makes it "
    "anew, in\n"
    "about five CPU hours. Finished runs are kept (--cache): a build that was stopped goes on "
    "where it "
    "was.\n"
    "Example: mpirun -np 8 mpm atlas -o atlas.h5, then GRANULAW_ATLAS=atlas.h5 mpm table ...",
    define, true};

}  // namespace granulaw
