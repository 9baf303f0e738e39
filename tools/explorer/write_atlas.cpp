// write_atlas ATLAS.h5 OUTPUT: the atlas as an array of doubles (numbers_of), for the interactive page. The shapes of driven
// equator planes are left out: no law of a sphere needs them.
#include <cstdio>
#include <exception>
#include <fstream>
#include <vector>

#include "atlas/atlas_numbers.hpp"
#include "base/error.hpp"
#include "characterise/atlas_file.hpp"

int main(int count, char** arguments)
{
  using namespace granulaw;
  try {
    if (count != 3) fail("write_atlas", "needs ATLAS.h5 and OUTPUT");
    const Atlas all = read_atlas(arguments[1]);
    const std::vector<double> numbers = numbers_of(Atlas(all.grid(), all.nodes(), all.elastic_spheres(), all.checks()));
    std::ofstream file(arguments[2], std::ios::binary);
    file.write(reinterpret_cast<const char*>(numbers.data()), static_cast<std::streamsize>(numbers.size() * sizeof(double)));
    file.close();
    if (!file) fail(arguments[2], "cannot be written");
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "write_atlas: %s\n", failure.what());
    return 1;
  }
}
