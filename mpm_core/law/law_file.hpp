#pragma once

#include <span>
#include <string>

#include "law/law.hpp"

namespace granulaw {

/// Key of Law::provenance under which read_law() gives the file's checksum (h5_checksum.hpp). Absent:
/// another program wrote the file. write_law() makes a new one.
inline constexpr const char* checksum_note = "checksum";

/// Reads a law file (HDF5; layout in docs/reference/law-format.md, every name in layout.hpp). Any file that
/// is not a whole, sane law of this major version gives one sentence as Error; never a crash or a large
/// allocation.
Law read_law(const std::string& path);

/// The same out of `image`, the bytes of a law file that read_law(path) accepts: for the other ranks of an
/// MPI run.
Law read_law_image(std::span<const char> image, const std::string& path);

/// Atomically (base/atomic_write.hpp): a reader sees the old file or the new one, never a part.
void write_law(const Law& law, const std::string& path);

}  // namespace granulaw
