#pragma once

#include <hdf5.h>

#include <string>

#include "law/orientation_check.hpp"

/// The group `orientations` of a body in a law file (docs/reference/law-format.md).
namespace granulaw::h5 {

/// Orientations of one body, and of all bodies of a file together.
inline constexpr std::size_t most_orientations = 16384;

ShapeCertificate read_shape_certificate(hid_t owner, const std::string& where);
void write_shape_certificate(hid_t owner, const ShapeCertificate& oriented, const std::string& where);

/// Throws Error where the numbers are none of a certificate.
void check_shape_certificate(const ShapeCertificate& oriented, const std::string& where);

}  // namespace granulaw::h5
