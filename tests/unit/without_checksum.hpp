#pragma once

#include <hdf5.h>

namespace granulaw::tests {

/// Makes an open law file one of minor version 0, which has no checksum: with it every damage is refused for
/// that alone, and the reader's other checks go untested.
inline void without_checksum(hid_t file)
{
  H5Adelete(file, "checksum");
  const int minor = 0;
  const hid_t attribute = H5Aopen(file, "version_minor", H5P_DEFAULT);
  H5Awrite(attribute, H5T_NATIVE_INT, &minor);
  H5Aclose(attribute);
}

}  // namespace granulaw::tests
