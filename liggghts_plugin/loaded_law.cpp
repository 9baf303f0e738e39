#include "liggghts_plugin/loaded_law.hpp"

#include "base/error.hpp"
#include "law/law_file.hpp"
#include "liggghts_plugin/liggghts.hpp"

namespace granulaw::plugin {

std::shared_ptr<const LoadedLaw> load_law(LAMMPS_NS::LAMMPS* lmp, const std::string& path,
                                          const std::string& where)
{
  auto loaded = std::make_shared<LoadedLaw>();
  std::string message;
  try {
    loaded->path = path;
    loaded->law = read_law(path);
    const auto add = [&](const BodyLaw& body) { loaded->curves.emplace(&body.curve, FastCurve(body.curve)); };
    for (const auto& [name, body] : loaded->law.bodies) add(body);
    for (const auto& [name, own] : loaded->law.pair_laws) add(own.law);
  } catch (const std::exception& error) {
    message = error.what();
  }

  // The lowest rank that failed speaks for all.
  int rank = 0, ranks = 1;
  MPI_Comm_rank(lmp->world, &rank);
  MPI_Comm_size(lmp->world, &ranks);
  int failed = message.empty() ? ranks : rank, first = ranks;
  MPI_Allreduce(&failed, &first, 1, MPI_INT, MPI_MIN, lmp->world);
  if (first == ranks) return loaded;
  int length = static_cast<int>(message.size());
  MPI_Bcast(&length, 1, MPI_INT, first, lmp->world);
  message.resize(static_cast<std::size_t>(length));
  MPI_Bcast(message.data(), length, MPI_CHAR, first, lmp->world);
  fail(where, message);
}

}  // namespace granulaw::plugin
