#pragma once

#include "request.hpp"

namespace granulaw {

/// Requirements of a bed of the request's bodies on a floor, by the functions of `mpm plan` and `mpm stretch`. Every contact
/// is at most as fast as the request's speed (--speed), the bed is `height` m high (--fill-height), gravity is 9.81 m/s^2.
/// Keys are those of the two commands' --json.
Json bed_json(const Atlas& atlas, const Request& request, double height);

}  // namespace granulaw
