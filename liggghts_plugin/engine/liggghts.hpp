#pragma once

// Every LIGGGHTS header that the plug-in uses, in the one order that compiles: fix_insert_stream.h must come
// before granular_styles.h, and the style_<kind>_model.h lists are generated when the build is configured.
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_insert_stream.h"
#include "fix_mesh_surface.h"
#include "fix_property_atom.h"
#include "fix_wall_gran.h"
#include "force.h"
#include "global_properties.h"
#include "granular_styles.h"
#include "modify.h"
#include "neighbor.h"
#include "output.h"
#include "pair_gran_proxy.h"
#include "universe.h"
#include "update.h"

#ifdef BIG
#undef BIG  // global_properties.h
#endif
