#include "liggghts_plugin/deck/loaded_law.hpp"

#include <fstream>
#include <iterator>

#include "base/error.hpp"
#include "law/law_file.hpp"
#include "liggghts_plugin/engine/liggghts.hpp"

namespace granulaw::plugin {

namespace {

/// From rank 0 to all others.
void broadcast(LAMMPS_NS::LAMMPS* lmp, std::string& text)
{
  int length = static_cast<int>(text.size());
  MPI_Bcast(&length, 1, MPI_INT, 0, lmp->world);
  text.resize(static_cast<std::size_t>(length));
  MPI_Bcast(text.data(), length, MPI_CHAR, 0, lmp->world);
}

}  // namespace

std::shared_ptr<const LoadedLaw> load_law(LAMMPS_NS::LAMMPS* lmp, const std::string& path,
                                          const std::string& where)
{
  auto loaded = std::make_shared<LoadedLaw>();
  loaded->path = path;
  std::string message, image;
  if (lmp->comm->me == 0) try {
      loaded->law = read_law(path);  // refuses what is no file
      std::ifstream file(path, std::ios::binary);
      image.assign(std::istreambuf_iterator<char>(file), {});
    } catch (const std::exception& error) {
      message = error.what();
    }
  broadcast(lmp, message);
  if (!message.empty()) fail(where, message);
  const bool is_shared = lmp->comm->nprocs > 1;
  if (is_shared) broadcast(lmp, image);
  if (is_shared) try {  // rank 0, too: the file may have been replaced between its two readings
      loaded->law = read_law_image(image, path);
    } catch (const std::exception& error) {
      message = error.what();
    }
  int failed = message.empty() ? 0 : 1;
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, lmp->world);
  if (failed) fail(where, "it was replaced while it was read, or a rank lacks memory for it", path);
  return loaded;
}

}  // namespace granulaw::plugin
