// granulaw_make_atlas: computes the atlas of homogeneous materials that mpm table takes its laws from. A new one takes
// about five CPU hours. Finished runs are cached (--cache): a build that was stopped goes on where it was.
//
//     mpirun -np 8 granulaw_make_atlas -o atlas.h5, then GRANULAW_ATLAS=atlas.h5 mpm table ...
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <memory>
#include <optional>
#include <string>

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "characterise/atlas_file.hpp"
#include "farm_options.hpp"
#include "make_atlas.hpp"
#include "option_checks.hpp"
#include "ranks.hpp"
#include "terminal.hpp"

using namespace granulaw;

namespace {

struct AtlasCommand
{
  std::string output, from;
  AtlasRequest atlas;
  FarmOptions farm;
};

void make(AtlasCommand& r)
{
  check_output("-o", r.output, ".h5");
  const std::unique_ptr<Farm> farm = r.farm.farm();
  std::optional<Atlas> known;
  if (!r.from.empty()) known = read_atlas(r.from), r.atlas.known = &*known;
  ProgressBar bar(rank() == 0);
  const Atlas atlas = make_atlas(r.atlas, *farm, [&](double done, const std::string& what) { bar.update(done, what); });
  bar.clear();
  if (rank() != 0) return;
  write_atlas(atlas, r.output);
  fmt::print("wrote {}: {} materials; {} fresh impacts: 95 % within {:.2g} % of force and {:.2g} of e\n", r.output, atlas.nodes().size(), atlas.checks().size(),
      100 * atlas.claimed_force(), atlas.claimed_restitution());
  const MidplaneShapes& midplane = atlas.midplane();
  fmt::print("midplane: {} materials; {} fresh presses: 95 % within {:.2g} % of force, {:.2g} of e, {:.2g} % of the recovery\n", midplane.nodes().size(),
      midplane.checks().size(), 100 * midplane.claimed_force(), midplane.claimed_restitution(), 100 * midplane.claimed_recovery());
  print_count(farm->count());
}

void define(Options& command, AtlasCommand& r)
{
  command.add_option("-o,--output", r.output, "atlas, NAME.h5").required();
  const Option from = command.add_option("--from", r.from, "an atlas whose materials stay as they are: only those that it lacks and the fresh impacts are run");
  command.add_flag("--impacts", r.atlas.impacts_anew, "with --from: recompute the fast impacts (velocity effects) of its materials (an hour of CPU time)").needs(from);
  command.add_flag("--radii", r.atlas.radii_alone, "with --from: recompute the radii of unloading alone, by presses of 40 materials (a quarter of an hour of CPU time)").needs(from);
  command.add_flag("--midplane", r.atlas.midplane_alone, "with --from: recompute the midplane presses alone (half an hour of CPU time)").needs(from);
  command.add_option("--midplane-checks", r.atlas.midplane_checks, "fresh midplane presses, which measure their error")
      .check(whole_from_to(20, 100000))
      .capture_default_str();
  command.add_option("--checks", r.atlas.checks, "fresh impacts of random materials, which measure the atlas's error")
      .check(whole_from_to(20, 100000))
      .capture_default_str();
  command.add_option("--seed", r.atlas.seed, "seed of the random materials").capture_default_str();
  r.farm.add_to(command);
}

}  // namespace

int main(int argc, char** argv)
{
  CLI::App app{"Computes the atlas: laws over E*/Y, Poisson's ratio, linear hardening, overlap and inertia"};
  Options options(app);
  AtlasCommand request;
  define(options, request);
  try {
    join_ranks("atlas", true);
    catch_interrupts();
    app.parse(argc, argv);
    make(request);
  } catch (const CLI::ParseError& error) {
    return leave_ranks(app.exit(error), {});
  } catch (const Interrupted&) {
    return leave_ranks(130, "stopped");
  } catch (const std::exception& error) {
    return leave_ranks(1, error.what());
  }
  return leave_ranks(0, {});
}
