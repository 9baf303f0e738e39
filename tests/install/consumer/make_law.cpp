// docs/reference/library.md: the contact law of a powder, for LIGGGHTS. make_law ATLAS LAW.h5
#include "characterise/atlas_file.hpp"
#include "characterise/file/make_law_file.hpp"
#include "law/law_file.hpp"

int main(int, char** argv)
{
  granulaw::LawFileRequest request;
  request.materials.materials["powder"] = {
      .density = 1500, .youngs_modulus = 10e9, .poisson_ratio = 0.3, .yield_stress = 100e6};
  request.pairs = {{"powder", "powder"}, {"powder", "wall"}};
  const granulaw::Atlas atlas = granulaw::read_atlas(argv[1]);
  request.atlas = &atlas;
  const granulaw::LawFilePlan plan = granulaw::plan_law_file(request);
  granulaw::write_law(granulaw::make_law_file(plan).law, argv[2]);
}
