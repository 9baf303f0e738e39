#pragma once

#include <string>

namespace granulaw::h5 {

/// Fails (Error, one sentence) unless the file `path` is built of what write_law uses of HDF5, and soundly
/// so: superblock 0, groups as B-trees of version 1, object headers of version 1, plain datasets and
/// attributes of integers, IEEE floats and texts of fixed length (HDF5 File Format Specification 2.0;
/// libhdf5's default and h5py's). Every part lies within the file, belongs to one owner, and leads to no part
/// before it.
///
/// Why: libhdf5 1.10 trusts what it parses. One flipped byte makes it allocate gigabytes or exabytes, and
/// crafted ones make it crash. After this check it only meets lengths and addresses that were seen to be
/// sound. Numbers and names are the reader's matter. Reads the whole file, at most 128 MiB.
void check_structure(const std::string& path);

}  // namespace granulaw::h5
