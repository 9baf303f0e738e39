#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "law/orientation_check.hpp"

namespace granulaw {

/// A certificate over orientations as `mpm shape --json` prints it and plot_shape.py draws it.
nlohmann::ordered_json as_json(const ShapeCertificate& certificate);

/// Three lines: what the law of spheres gives, and what it is off by.
void print_shape(const std::string& name, const ShapeCertificate& certificate);

/// Draws the map of its errors over the orientations: NAME.png, .pdf or .svg. `command` leads messages.
void draw_shape(const char* command, const std::string& name, const ShapeCertificate& certificate, const std::string& picture);

}  // namespace granulaw
