// The medium at a point: nested, of meshes, behind other shapes, and without bounds.
#include "inside.h"

#include "scenes.h"
#include "shapes.h"
#include "test.h"

static pm_vec3 up(double z)
{
    return pm_vec(0.01, -0.02, z);
}

static void media_lie_one_in_the_other(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    int fog = pm_scenes_medium(&s, 1.0, pm_gray(0.5), 0.0);
    int milk = pm_scenes_medium(&s, 2.0, pm_gray(0.5), 0.0);
    pm_vec3 middle = {0.0, 0.0, 0.0};
    pm_frame askew = pm_shapes_askew();
    pm_scenes_wear(&s, pm_shapes_sphere(middle, 2.5), pm_scenes_diffuse(&s, pm_gray(0.5)));
    pm_scenes_wear(&s, pm_shapes_sphere(middle, 0.2), pm_scenes_glass(&s, 1.5));
    pm_scenes_bound(&s, pm_shapes_sphere(middle, 2.0), fog, PM_NONE);
    pm_scenes_bound(&s, pm_shapes_cube(&askew, middle, 0.5), milk, fog);
    pm_shape hole = pm_shapes_sphere(middle, 0.4);
    hole.flipped = true;
    pm_scenes_bound(&s, hole, milk, PM_NONE);
    pm_scenes_ready(&s);
    CHECK(pm_inside_medium(&s.world, up(3.0)) == PM_NONE);
    CHECK(pm_inside_medium(&s.world, up(2.2)) == PM_NONE);
    CHECK(pm_inside_medium(&s.world, up(1.5)) == fog);
    CHECK(pm_inside_medium(&s.world, up(0.45)) == milk);
    CHECK(pm_inside_medium(&s.world, up(0.3)) == PM_NONE);
    CHECK(pm_inside_medium(&s.world, middle) == PM_NONE);
    pm_scenes_free(&s);
}

static void without_bounds_it_is_the_lights(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    int fog = pm_scenes_medium(&s, 1.0, pm_gray(0.5), 0.0);
    pm_scenes_wear(&s, pm_shapes_sphere(up(0.0), 1.0), pm_scenes_diffuse(&s, pm_gray(0.5)));
    pm_scenes_point(&s, up(2.0), pm_gray(1.0));
    pm_scenes_ready(&s);
    CHECK(pm_inside_medium(&s.world, up(5.0)) == PM_NONE);
    s.lights[0].medium = fog;
    CHECK(pm_inside_medium(&s.world, up(5.0)) == fog);
    pm_scenes_free(&s);
}

PM_TESTS({"inside.1", "media lie one in the other, and other shapes tell nothing",
          media_lie_one_in_the_other},
         {"inside.2", "where nothing parts media, the lights tell",
          without_bounds_it_is_the_lights})
