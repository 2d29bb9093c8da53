// Core's C headers as C++ reads them. They use compound literals, which C++ compilers take but
// call an extension. photon.h stays on the C side: drawing knows plain arrays, not maps.
#ifndef PM_CORE_HH
#define PM_CORE_HH

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
extern "C" {
#include "scene.h"
#include "spectrum.h"
#include "status.h"
#include "vec.h"
}
#pragma GCC diagnostic pop

#endif
