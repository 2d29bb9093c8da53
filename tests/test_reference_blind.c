// What the reference says that its picture cannot show.
#include "reference_blind.h"

#include "references.h"
#include "scenes.h"
#include "shapes.h"
#include "test.h"

#include <string.h>

static void check_blind(pm_scenes *s, bool light_paths, const char *want)
{
    char sentence[PM_REFERENCE_BLIND_ROOM];
    pm_reference_blind(&s->scene, light_paths, sentence);
    CHECK_THAT(strcmp(sentence, want) == 0, "got \"%s\"", sentence);
}

static void blindness_is_named(void)
{
    const double cone[2] = {0.3, 0.9};
    pm_scenes s;
    pm_scenes_begin(&s);
    int white = pm_scenes_diffuse(&s, pm_gray(0.5));
    int lamp = pm_scenes_wear(&s, pm_scenes_square(1.0, 1.0, true), white);
    pm_scenes_lamp(&s, lamp, pm_gray(1.0));
    int ball = pm_scenes_wear(&s, pm_shapes_sphere(pm_vec(0.0, 0.0, 0.0), 0.5),
                              pm_scenes_glass(&s, 1.5));
    check_blind(&s, false, ""); // lamps are met by chance
    pm_scenes_point(&s, pm_vec(0.0, 0.0, 2.0), pm_gray(0.0));
    check_blind(&s, false, ""); // no power
    pm_scenes_spot(&s, pm_vec(0.0, 0.0, 2.0), pm_vec(0.0, 0.0, -1.0), cone, pm_gray(1.0));
    pm_scenes_point(&s, pm_vec(0.0, 0.0, 2.0), pm_gray(1.0));
    check_blind(&s, false,
                "missing: caustics of point and spot lights by smooth glass and mirrors, the"
                " indirect light these give (--light-paths N traces both), and what glass and"
                " mirrors show of them");
    check_blind(&s, true,
                "missing: what smooth glass and mirrors show of the caustics of point and spot"
                " lights and of the light these give");
    s.shapes[ball].material[0] = s.shapes[ball].material[1] =
        pm_scenes_rough_mirror(&s, PM_MICROFACET_GGX, 0.05);
    check_blind(&s, false, ""); // rough lobes take light from anywhere
    pm_scenes_free(&s);
}

/// Nothing here spreads light but the fog.
static void blindness_in_fog_is_named(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    int fog = pm_scenes_medium(&s, 1.0, pm_gray(0.0), 0.0);
    pm_scenes_bound(&s, pm_shapes_sphere(pm_vec(0.0, 0.0, 0.0), 1.0), fog, PM_NONE);
    int ball = pm_scenes_wear(&s, pm_shapes_sphere(pm_vec(0.0, 0.0, 0.0), 0.5),
                              pm_scenes_glass(&s, 1.5));
    pm_scenes_sun(&s, pm_vec(0.0, 0.0, -1.0), pm_gray(1.0));
    pm_scenes_ready(&s);
    check_blind(&s, false, ""); // it scatters nothing
    s.media[fog].albedo = pm_rgb(0.0, 0.0, 0.1);
    check_blind(&s, false,
                "missing: caustics of directional lights by smooth glass and mirrors, in media"
                " too, the indirect light these give (--light-paths N traces both), and what"
                " glass and mirrors show of them");
    check_blind(&s, true,
                "missing: what smooth glass and mirrors show of the caustics of directional"
                " lights, in media too, and of the light these give");
    s.media[fog].sigma_t = 0.0;
    check_blind(&s, true, "");
    s.media[fog].sigma_t = 1.0;
    s.shapes[ball].material[0] = s.shapes[ball].material[1] = pm_scenes_null(&s);
    check_blind(&s, false, ""); // light comes straight
    pm_scenes_free(&s);
}

PM_TESTS({"reference_blind.1", "what the picture cannot show is named, and nothing else",
          blindness_is_named},
         {"reference_blind.2", "what the picture cannot show of light in fog is named",
          blindness_in_fog_is_named})
