// What a user's settings change of a picture: nothing is left out in silence.
#ifndef PM_CHOICE_H
#define PM_CHOICE_H

#include "render.h"

#define PM_CHOICES_MAX 16

/// One setting that is not the default and bears on which light is shown, or how well.
typedef struct {
    char option[32];  // as it was given: "--gather 0"
    char effect[256]; // one sentence without a full stop; it names the path classes
    bool missing;     // paths are left out of the picture
    bool idle;        // the setting has nothing to do in this picture
} pm_choice;

/// @param maps     planned (pm_render_plan()) or made
/// @param choices  [out] room for PM_CHOICES_MAX
/// @return how many there are
int pm_choice_list(const pm_render_settings *settings, const pm_render_maps *maps,
                   pm_choice choices[PM_CHOICES_MAX]);

#endif
