// What a picture's report says in a line: render --report and reference --report, written
// beside the picture as NAME.json for NAME.exr.
#ifndef PM_CONTACT_NOTE_H
#define PM_CONTACT_NOTE_H

#include "status.h"

#include <stddef.h>

/// Photons, gather rays and samples, those that the report has, and the time that it took.
///
/// @param picture  path of the picture, *.exr
/// @param note     [out] at most `room` bytes; "" when there is no report
/// @param seconds  [out] 0 when it is not known
/// @return PM_EINPUT with a line when the file there is no JSON
pm_status pm_contact_note(const char *picture, char *note, size_t room, double *seconds);

#endif
