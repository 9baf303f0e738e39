// The name of the fix; LAMMPS's build lists headers whose names begin with fix_.
#ifdef FIX_CLASS
// clang-format off
FixStyle(granulaw/law,FixGranulawLaw);
// clang-format on
#else
#include "gran_sub_mod_granulaw.h"
#endif
