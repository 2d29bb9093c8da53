// Values of an object's parameters. Every function looks for the parameter `name` of `object`,
// gives `otherwise` when it is not there, and after reporting a fault gives something harmless.
#ifndef PM_SCENE_VALUE_H
#define PM_SCENE_VALUE_H

#include "scene_file.h"
#include "transform.h"

/// The element that gives the parameter, or NULL.
const pm_xml *pm_scene_value_find(const pm_xml *object, const char *name);

/// A finite number.
double pm_scene_value_number(pm_scene_file *source, const pm_xml *object, const char *name,
                             double otherwise);

/// A finite number > 0.
double pm_scene_value_positive(pm_scene_file *source, const pm_xml *object, const char *name,
                               double otherwise);

/// A whole number from 1 to `most`.
int pm_scene_value_count(pm_scene_file *source, const pm_xml *object, const char *name,
                         int most, int otherwise);

bool pm_scene_value_switch(pm_scene_file *source, const pm_xml *object, const char *name,
                           bool otherwise);

const char *pm_scene_value_text(const pm_xml *object, const char *name, const char *otherwise);

pm_vec3 pm_scene_value_triple(pm_scene_file *source, const pm_xml *object, const char *name,
                              pm_vec3 otherwise);

/// A transform that is not singular.
pm_transform pm_scene_value_transform(pm_scene_file *source, const pm_xml *object,
                                      const char *name);

/// Three values from 0 to 1.
pm_spectrum pm_scene_value_ratio(pm_scene_file *source, const pm_xml *object, const char *name,
                                 double otherwise);

/// Three values >= 0, or > 0 when `positive`.
pm_spectrum pm_scene_value_amount(pm_scene_file *source, const pm_xml *object, const char *name,
                                  double otherwise, bool positive);

/// Three values >= 0 of emitted light. A <spectrum> of one value means that value at every
/// wavelength, which is not neutral in sRGB: Mitsuba's conversion is the same.
pm_spectrum pm_scene_value_emission(pm_scene_file *source, const pm_xml *object,
                                    const char *name);

#endif
