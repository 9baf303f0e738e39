// mpm atlas: computes the atlas of homogeneous materials that mpm table takes its laws from.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "characterise/run/sampling_plan.hpp"
#include "characterise/atlas_file.hpp"
#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "characterise/atlas_build.hpp"
#include "characterise/midplane_build.hpp"
#include "command.hpp"
#include "farm_options.hpp"
#include "option_checks.hpp"
#include "ranks.hpp"
#include "terminal.hpp"

namespace granulaw {

namespace of_atlas {

struct AtlasRequest
{
  std::string output;
  std::string from;       ///< an atlas whose materials stay; empty: all are run
  bool impacts = false;   ///< but their fast impacts, which are run
  bool midplane = false;  ///< all of it stays but the midplane presses, which are run
  int checks = 500, midplane_checks = 100;
  unsigned seed = 1;
  FarmOptions farm;
};

/// A part of the bar, from one share of the whole to another.
Progress part_of(ProgressBar& bar, double from, double to)
{
  return
      [&bar, from, to](double done, const std::string& what) { bar.update(from + (to - from) * done, what); };
}

/// Midplane presses, then fresh ones that give their error.
Atlas with_midplane(const Atlas& free, const AtlasRequest& r, Farm& farm, ProgressBar& bar, double from)
{
  const MidplaneGrid grid;
  const RunSource source;
  const double middle = 0.5 * (from + 1);
  const auto atlas = [&](MidplaneShapes shapes) {
    return Atlas(free.grid(), free.nodes(), free.elastic_spheres(), free.checks(), std::move(shapes));
  };
  const Atlas bare =
      atlas(midplane_from(free, grid, farm.run(midplane_jobs(grid, source), part_of(bar, from, middle))));
  return atlas(bare.midplane().with_checks(
      check_midplane(bare, farm, r.midplane_checks, r.seed, part_of(bar, middle, 1))));
}

/// All materials of the grid, then the fresh impacts that give the error, then midplane presses.
Atlas build(const AtlasRequest& r, Farm& farm)
{
  ProgressBar bar(rank() == 0);
  std::optional<Atlas> known;
  if (!r.from.empty()) known = read_atlas(r.from);
  if (r.midplane) return with_midplane(*known, r, farm, bar, 0);
  const KnownAtlas of{known ? &*known : nullptr, r.impacts};
  const AtlasGrid grid;
  const RunSource source;
  const Atlas bare = atlas_from(grid, farm.run(atlas_jobs(grid, source, of), part_of(bar, 0, 0.7)), of);
  const Atlas free(grid, bare.nodes(), bare.elastic_spheres(),
                   check_atlas(bare, farm, r.checks, r.seed, part_of(bar, 0.7, 0.9)));
  return with_midplane(free, r, farm, bar, 0.9);
}

void make_atlas(const AtlasRequest& r)
{
  check_output("-o", r.output, ".h5");
  const std::unique_ptr<Farm> farm = r.farm.farm();
  const Atlas atlas = build(r, *farm);
  if (rank() != 0) return;
  write_atlas(atlas, r.output);
  fmt::print("wrote {}: {} materials; {} fresh impacts: 95 % within {:.2g} % of force and {:.2g} of e\n",
             r.output, atlas.nodes().size(), atlas.checks().size(), 100 * atlas.claimed_force(),
             atlas.claimed_restitution());
  const MidplaneShapes& midplane = atlas.midplane();
  fmt::print(
      "midplane: {} materials; {} fresh presses: 95 % within {:.2g} % of force, {:.2g} of e, {:.2g} % of "
      "the recovery\n",
      midplane.nodes().size(), midplane.checks().size(), 100 * midplane.claimed_force(),
      midplane.claimed_restitution(), 100 * midplane.claimed_recovery());
  print_count(farm->count());
}

void define(Options& command)
{
  const auto r = std::make_shared<AtlasRequest>();
  command.add_option("-o,--output", r->output, "atlas, NAME.h5")->required();
  const Option from =
      command.add_option("--from", r->from,
                         "an atlas whose materials stay as they are: only those that it lacks and the fresh "
                         "impacts are run");
  command
      .add_flag(
          "--impacts", r->impacts,
          "with --from: recompute the fast impacts (velocity effects) of its materials (an hour of CPU time)")
      ->needs(from);
  command
      .add_flag("--midplane", r->midplane,
                "with --from: recompute the midplane presses alone (half an hour of CPU time)")
      ->needs(from);
  command
      .add_option("--midplane-checks", r->midplane_checks,
                  "fresh midplane presses, which measure their error")
      ->check(whole_from_to(20, 100000))
      ->capture_default_str();
  command
      .add_option("--checks", r->checks, "fresh impacts of random materials, which measure the atlas's error")
      ->check(whole_from_to(20, 100000))
      ->capture_default_str();
  command.add_option("--seed", r->seed, "seed of the random materials")->capture_default_str();
  r->farm.add_to(command);
  command.callback([r] { make_atlas(*r); });
}

}  // namespace of_atlas

extern const Command atlas_command{
    "atlas",
    "Computes the atlas: dimensionless laws over E*/Y, Poisson's ratio, linear hardening, overlap and "
    "inertia.\n"
    "mpm table interpolates laws of homogeneous materials in it. One comes with the program; a new one "
    "takes\n"
    "about five CPU hours. Finished runs are cached (--cache): a build that was stopped goes on where it "
    "was.\n"
    "Example: mpirun -np 8 mpm atlas -o atlas.h5, then GRANULAW_ATLAS=atlas.h5 mpm table ...",
    of_atlas::define, true};

}  // namespace granulaw
