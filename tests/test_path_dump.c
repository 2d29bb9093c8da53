// The dump of paths: rows in order, and glass told from mirrors by the side on which the photon
// goes on.
#include "command.h"
#include "path_dump.h"
#include "test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const pm_start start = {.photon = 7, .power = {{4.0, 4.0, 4.0}}};

/// An event of the photon on a floor met from above, which it reached along `direction`.
static void meet(pm_path_dump *dump, uint32_t bounce, char scatter, pm_vec3 direction)
{
    pm_lobes lobes = {.normal = pm_vec(0.0, 0.0, 1.0)};
    pm_event event = {.kind = PM_EVENT_SURFACE,
                      .scatter = scatter,
                      .bounce = bounce,
                      .lobes = &lobes,
                      .direction = direction,
                      .position = pm_vec(bounce, 0.0, 0.0)};
    pm_path_dump_event(dump, &start, &event);
}

static char *read_text(const char *path)
{
    static char text[2048];
    FILE *file = fopen(path, "r");
    CHECK(file != NULL);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    return text;
}

static void side_tells_glass_from_mirror(void)
{
    const char *path = pm_command_path("paths.csv");
    pm_scene scene = {.radius = 10.0};
    pm_path_dump dump;
    CHECK_OK(pm_path_dump_begin(path, &scene, 2, &dump));
    meet(&dump, 0, 'S', pm_vec(0, 0, -1)); // turned back: the next one comes from above
    meet(&dump, 1, 'S', pm_vec(0, 0, 1));  // goes on below
    meet(&dump, 2, 'D', pm_vec(0, 0, -1)); // a diffuse one is D wherever it goes
    meet(&dump, 3, 'S', pm_vec(0, 0, -1)); // nothing follows
    CHECK_OK(pm_path_dump_commit(&dump));
    CHECK_CONTAINS(read_text(path), "photon,step,event,x,y,z,r,g,b\n"
                                    "7,0,L,0,0,0,2,2,2\n"
                                    "7,1,S,0,0,0,0,0,0\n"
                                    "7,2,T,1,0,0,0,0,0\n"
                                    "7,3,D,2,0,0,0,0,0\n"
                                    "7,4,S,3,0,0,0,0,0\n");
}

/// In cornell-spheres glass is at x > 0 and the mirror at x < 0. What goes into the ball comes
/// out of it again, less what its wall reflects.
static void balls_have_their_letters(void)
{
    const char *path = pm_command_path("paths.csv");
    pm_test_ran ran =
        pm_command_run("tracing {S} -n 4000 --dump {O}", "scenes/cornell-spheres.xml", path);
    CHECK(ran.exit_code == 0);
    pm_test_ran_free(&ran);
    FILE *file = fopen(path, "r");
    CHECK(file != NULL);
    char line[256];
    int through[2] = {0};
    int mirrored[2] = {0};
    while (fgets(line, sizeof line, file) != NULL) {
        char event = 0;
        double x = 0.0;
        if (sscanf(line, "%*u,%*u,%c,%lf", &event, &x) == 2) {
            through[x > 0.0] += event == 'T';
            mirrored[x > 0.0] += event == 'S';
        }
    }
    fclose(file);
    CHECK_THAT(through[0] == 0 && through[1] > 200, "%d and %d went through", through[0],
               through[1]);
    CHECK_THAT(mirrored[0] > 200 && mirrored[1] > 10 && mirrored[1] < mirrored[0] / 2,
               "%d and %d were mirrored", mirrored[0], mirrored[1]);
}

PM_TESTS({"path_dump.1", "S goes on where it came from, T on the other side",
          side_tells_glass_from_mirror},
         {"path_dump.2", "nothing goes through the mirror ball, and much through the glass one",
          balls_have_their_letters})
