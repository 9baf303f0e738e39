#pragma once

namespace granulaw::plugin {

/// Numbers of our normal models among LIGGGHTS's. Six bits; the stock models end at 12, 9 is "off". They are
/// written into restart files: never change one.
inline constexpr int mpm_id = 40, thornton_id = 41, hertz_copy_id = 42, hertz_loop_id = 43;

}  // namespace granulaw::plugin
