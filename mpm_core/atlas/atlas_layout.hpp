#pragma once

#include <vector>

#include "atlas/atlas.hpp"
#include "law/layout.hpp"

namespace granulaw {

/// An atlas taken apart.
struct AtlasParts
{
  AtlasGrid grid;
  std::vector<LatticeNode> nodes;
  std::vector<ElasticSphere> elastic;
  std::vector<AtlasCheck> checks;
  MidplaneGrid midplane_grid;
  std::vector<ElasticCorrection> midplane_elastic;
  std::vector<LatticeNode> midplane_nodes;
  std::vector<MidplaneCheck> midplane_checks;
};
AtlasParts parts_of(const Atlas& atlas);
/// Throws Error where the parts do not belong together.
Atlas atlas_of(AtlasParts parts);

/// A list of numbers of an atlas: name and legend, and the place of each number. The file (HDF5) and the array
/// (atlas_numbers.hpp) are written and read through the one table of them, in its order.
struct AtlasDataset
{
  h5::Field field;
  std::vector<double*> (*numbers)(AtlasParts&);
  /// Makes room for so many numbers; null: earlier lists make it.
  void (*make_room)(AtlasParts&, std::size_t count);
  /// May be absent: the atlas has no checks, no midplane, or is older than the radii of unloading, which are then those
  /// of an elastic body.
  enum class Presence { always, radii, checks, midplane, midplane_checks } presence;
  /// In the file. Law shapes are rounded to single precision (6e-8), which halves it.
  enum class Form { list, rounded_list, scalar } form = Form::list;
};
const std::vector<AtlasDataset>& atlas_datasets();

/// Fills one list. Throws Error naming `where` where the count is wrong or a number is not finite.
void fill(AtlasParts& parts, const AtlasDataset& dataset, const std::vector<double>& values,
          const std::string& where);

}  // namespace granulaw
