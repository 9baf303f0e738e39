#include "make_atlas.hpp"

#include <string>

#include "atlas_build.hpp"
#include "midplane_build.hpp"
#include "radii_build.hpp"
#include "characterise/run/sampling_plan.hpp"

namespace granulaw {

namespace {

/// A part of the whole, from one share of it to another.
Progress part_of(const Progress& whole, double from, double to)
{
  if (!whole) return {};
  return [&whole, from, to](double done, const std::string& what) { whole(from + (to - from) * done, what); };
}

/// `free` with midplane presses, then fresh ones that give their error.
Atlas with_midplane(const Atlas& free, const AtlasRequest& r, Farm& farm, const Progress& progress, double from)
{
  const MidplaneGrid grid;
  const double middle = 0.5 * (from + 1);
  const auto with = [&](MidplaneShapes shapes) {
    return Atlas(free.grid(), free.nodes(), free.elastic_spheres(), free.checks(), std::move(shapes));
  };
  const Atlas bare = with(
      midplane_from(free, grid, farm.run(midplane_jobs(grid, RunSource{}), part_of(progress, from, middle))));
  return with(bare.midplane().with_checks(
      check_midplane(bare, farm, r.midplane_checks, r.seed, part_of(progress, middle, 1))));
}

}  // namespace

Atlas make_atlas(const AtlasRequest& r, Farm& farm, const Progress& progress)
{
  if (r.radii_alone) {
    const RadiusGrid few;
    return with_radii(*r.known, few, farm.run(radius_jobs(few, RunSource{}), progress));
  }
  if (r.midplane_alone) return with_midplane(*r.known, r, farm, progress, 0);
  const KnownAtlas known{r.known, r.impacts_anew};
  const AtlasGrid grid;
  const Atlas bare =
      atlas_from(grid, farm.run(atlas_jobs(grid, RunSource{}, known), part_of(progress, 0, 0.7)), known);
  const Atlas free(grid, bare.nodes(), bare.elastic_spheres(),
                   check_atlas(bare, farm, r.checks, r.seed, part_of(progress, 0.7, 0.9)));
  return with_midplane(free, r, farm, progress, 0.9);
}

}  // namespace granulaw
