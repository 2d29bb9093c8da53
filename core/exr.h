// Pictures as OpenEXR: one part, scanlines, ZIP, 32-bit float, data window = display window, no
// time stamp, so that the same picture is the same bytes.
#ifndef PM_EXR_H
#define PM_EXR_H

#include "image.h"

/// Writes beside `path` and renames. PM_EIO with a line when that fails; no half file is left.
pm_status pm_exr_write(const char *path, const pm_image *image);

/// Reads any flat scanline EXR with up to PM_IMAGE_CHANNELS_MAX channels; half and uint become
/// float.
/// @param image  [out] untouched unless PM_OK
pm_status pm_exr_read(const char *path, pm_image *image);

#endif
