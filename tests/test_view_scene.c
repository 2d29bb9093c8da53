// What view draws around its data: the scene, and margins that belong to text alone.
#include "command.h"
#include "test.h"

#include <libpng16/png.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 1200, HEIGHT = 900, TOP = 108 }; // view's own size; text above TOP

/// The picture `view paths` makes of one path in `scene`, three bytes a pixel; to be freed.
static png_bytep draw_path(const char *scene, const char *vertices)
{
    char text[512];
    char line[512];
    char path[512];
    snprintf(text, sizeof text, "photon,step,event,x,y,z,r,g,b\n%s", vertices);
    snprintf(path, sizeof path, "%s", pm_command_write("paths.csv", text));
    snprintf(line, sizeof line, "view paths {S} --scene %s -o {O}", scene);
    pm_test_ran ran = pm_command_run(line, path, pm_command_path("out.png"));
    CHECK_THAT(ran.exit_code == 0, "%s: exit %d: %s", line, ran.exit_code, ran.err);
    pm_test_ran_free(&ran);
    png_image png;
    memset(&png, 0, sizeof png);
    png.version = PNG_IMAGE_VERSION;
    CHECK(png_image_begin_read_from_file(&png, pm_command_path("out.png")) != 0);
    png.format = PNG_FORMAT_RGB;
    CHECK(png.width == WIDTH && png.height == HEIGHT);
    png_bytep pixels = malloc(PNG_IMAGE_SIZE(png));
    CHECK(pixels != NULL && png_image_finish_read(&png, NULL, pixels, 0, NULL) != 0);
    return pixels;
}

/// Pixels of the rows from `first` to `end` that are yellow as a path's first stretch.
static int count_yellow(const png_byte *pixels, int first, int end)
{
    int found = 0;
    for (int i = first * WIDTH; i < end * WIDTH; i++) {
        const png_byte *rgb = pixels + 3 * i;
        found += rgb[0] > 90 && rgb[1] > 90 && rgb[2] < 2 * rgb[0] / 3;
    }
    return found;
}

static void keep_the_title_free(void)
{
    png_bytep pixels =
        draw_path("scenes/cornell-spheres.xml", "0,0,L,0,2,0,1,1,1\n0,1,A,0,0.1,0,1,1,1\n");
    CHECK(count_yellow(pixels, TOP, HEIGHT) > 300);
    CHECK(count_yellow(pixels, 0, TOP) == 0);
    free(pixels);
}

static double brightness(const png_byte *pixels, int left, int right)
{
    double sum = 0.0;
    for (int y = 410; y < 516; y++) {
        for (int x = left; x < right; x++) {
            const png_byte *rgb = pixels + 3 * (y * WIDTH + x);
            sum += rgb[0] + rgb[1] + rgb[2];
        }
    }
    return sum;
}

// OBJ files give each triangle vertices of its own; no edge of the sphere is sharp all the
// same.
static void draw_a_mesh_alike_from_ply_and_obj(void)
{
    png_bytep pixels =
        draw_path("scenes/mesh-spheres.xml", "0,0,L,7,-7,0.1,1,1,1\n0,1,A,7.5,-7,0,1,1,1\n");
    double left = brightness(pixels, 340, 456);
    double right = brightness(pixels, 456, 572);
    CHECK_NEAR(right / left, 1.0, 0.02);
    free(pixels);
}

PM_TESTS({"view_scene.1", "a path from far above does not run through the title",
          keep_the_title_free},
         {"view_scene.2", "the same sphere looks the same from PLY and from OBJ",
          draw_a_mesh_alike_from_ply_and_obj})
