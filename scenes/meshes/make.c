// Makes the meshes of the scenes: `make meshes` writes them again, byte for byte.
//
// Every mesh is a grid of `columns` by `rows` cells, two triangles each, their normals on the
// side from which columns run to the right and rows up. Coordinates are rounded to a 65,536th
// of a metre, so that the last digit of a sine, which libraries do not agree on, cannot show.
// Files are binary PLY with two-byte indices.
#include "file.h"
#include "vec.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/// A surface over u and v, both from 0 to 1.
typedef pm_vec3 (*surface)(double u, double v);

typedef struct {
    const char *name; // of the file
    const char *says; // its comment
    surface at;
    uint32_t columns, rows;
} mesh;

// --- water: waves over a square of 4 m by 4 m, z up
// --------------------------------------------

static const double pool = 4.0; // side [m]

/// Sines that run every way, steep enough to focus light a metre or two below. Their lengths
/// divide the pool, so the water meets its walls at no particular phase.
static pm_vec3 water(double u, double v)
{
    static const struct {
        int right, back; // waves that fit on the pool
        double height;   // [m]
        double phase;
    } waves[] = {{3, 2, 0.025, 0.3},  {-4, 1, 0.020, 1.9},  {1, -4, 0.018, 4.1},
                 {5, -2, 0.011, 2.7}, {-5, -4, 0.008, 0.9}, {2, 7, 0.006, 5.3},
                 {8, 1, 0.005, 3.7},  {-6, 6, 0.005, 1.2},  {-3, -9, 0.004, 2.2}};
    double z = 0.0;
    for (size_t i = 0; i < sizeof waves / sizeof waves[0]; i++) {
        double turns = waves[i].right * u + waves[i].back * v;
        z += waves[i].height * sin(2.0 * PM_PI * turns + waves[i].phase);
    }
    return pm_vec(pool * (u - 0.5), pool * (v - 0.5), z);
}

// --- shell: a tube that winds around the z axis, growing by the same factor each turn
// ----------

/// Ribs across the tube: sharp crests, wide hollows; height over the tube's radius.
static double rib(double turns)
{
    double phase = 24.0 * turns;
    double s = 0.5 + 0.5 * cos(2.0 * PM_PI * phase);
    return 0.13 * s * s * s;
}

/// Around the tube by u, along it by v.
static pm_vec3 shell(double u, double v)
{
    const double turns = 5.0;
    const double growth = 1.75; // each turn
    double turn = turns * (v - 1.0);
    double size = pow(growth, turn);
    double cord = 0.02 * cos(2.0 * PM_PI * 18.0 * u);
    double tube = 0.36 * size * (1.0 + rib(turn) + cord);
    double way = 2.0 * PM_PI * turn;
    double side = 0.42 * size + tube * cos(2.0 * PM_PI * u);
    double z = 1.30 * (1.0 - size) + 1.1 * tube * sin(2.0 * PM_PI * u);
    return pm_vec(side * cos(way), side * sin(way), z);
}

// --- files
// -------------------------------------------------------------------------------------

static const mesh meshes[] = {
    {"water.ply", "Waves over a pool of 4 m by 4 m", water, 192, 192},
    {"shell.ply", "A ribbed shell of 52,000 triangles", shell, 52, 500},
    {"shell-coarse.ply", "The same shell of 5,000 triangles", shell, 20, 125},
};

static void write_head(FILE *out, const mesh *m)
{
    fprintf(out, "ply\nformat binary_little_endian 1.0\ncomment %s\n", m->says);
    fprintf(out, "element vertex %u\n", (m->columns + 1) * (m->rows + 1));
    fputs("property float x\nproperty float y\nproperty float z\n", out);
    fprintf(out, "element face %u\n", 2 * m->columns * m->rows);
    fputs("property list uchar ushort vertex_indices\nend_header\n", out);
}

static void write_bytes(FILE *out, uint32_t value, int bytes)
{
    for (int i = 0; i < bytes; i++) {
        fputc((int)(value >> (8 * i) & 255u), out);
    }
}

static void write_coordinate(FILE *out, double metres)
{
    float rounded = (float)(round(metres * 65536.0) / 65536.0);
    uint32_t bits = 0;
    memcpy(&bits, &rounded, sizeof bits);
    write_bytes(out, bits, 4);
}

static void write_triangle(FILE *out, uint32_t a, uint32_t b, uint32_t c)
{
    write_bytes(out, 3, 1);
    write_bytes(out, a, 2);
    write_bytes(out, b, 2);
    write_bytes(out, c, 2);
}

static void write_grid(FILE *out, const mesh *m)
{
    for (uint32_t row = 0; row <= m->rows; row++) {
        for (uint32_t column = 0; column <= m->columns; column++) {
            pm_vec3 at = m->at((double)column / m->columns, (double)row / m->rows);
            write_coordinate(out, at.x);
            write_coordinate(out, at.y);
            write_coordinate(out, at.z);
        }
    }
    for (uint32_t row = 0; row < m->rows; row++) {
        for (uint32_t column = 0; column < m->columns; column++) {
            uint32_t here = row * (m->columns + 1) + column;
            uint32_t above = here + m->columns + 1;
            write_triangle(out, here, here + 1, above + 1);
            write_triangle(out, here, above + 1, above);
        }
    }
}

static pm_status write_mesh(const char *folder, const mesh *m)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s", folder, m->name);
    pm_file file;
    pm_status status = pm_file_begin(path, &file);
    if (status != PM_OK) {
        return status;
    }
    write_head(file.stream, m);
    write_grid(file.stream, m);
    return pm_file_commit(&file);
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fputs("usage: make-meshes FOLDER\n", stderr);
        return 2;
    }
    for (size_t i = 0; i < sizeof meshes / sizeof meshes[0]; i++) {
        if (write_mesh(argv[1], &meshes[i]) != PM_OK) {
            fprintf(stderr, "%s\n", pm_status_message());
            return 2;
        }
    }
    return 0;
}
