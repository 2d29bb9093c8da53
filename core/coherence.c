// Contract and formula in the header. Tiles are a sixteenth of the shorter side, at most 16
// pixels, and count when half of their pixels do.
#include "coherence.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#define TILE_MAX 16
#define TILES_WANTED 16
#define GAP                                                                                    \
    2 // tiles from one to its partner, so that what they share does not end between them

typedef struct {
    int side; // of a tile
    int columns, rows;
    bool *used;
    double *mean[3]; // of the difference and of both noises
} tiling;

static pm_status make_tiling(const pm_coherence_planes *planes, tiling *t)
{
    int shorter = planes->width < planes->height ? planes->width : planes->height;
    int side = shorter / TILES_WANTED;
    t->side = side < 1 ? 1 : side > TILE_MAX ? TILE_MAX : side;
    t->columns = planes->width / t->side;
    t->rows = planes->height / t->side;
    size_t count = (size_t)t->columns * (size_t)t->rows;
    t->used = calloc(count, sizeof *t->used);
    bool made = t->used != NULL;
    for (int i = 0; i < 3; i++) {
        t->mean[i] = calloc(count, sizeof *t->mean[i]);
        made = made && t->mean[i] != NULL;
    }
    return made ? PM_OK : PM_FAIL(PM_ENOMEM, "no memory for %zu tiles", count);
}

static void free_tiling(tiling *t)
{
    free(t->used);
    for (int i = 0; i < 3; i++) {
        free(t->mean[i]);
    }
}

static void average_tile(const pm_coherence_planes *planes, int column, int row, tiling *t)
{
    const double *plane[3] = {planes->difference, planes->noise[0], planes->noise[1]};
    double sum[3] = {0.0, 0.0, 0.0};
    int counted = 0;
    for (int y = row * t->side; y < (row + 1) * t->side; y++) {
        for (int x = column * t->side; x < (column + 1) * t->side; x++) {
            size_t pixel = (size_t)y * (size_t)planes->width + (size_t)x;
            if (!planes->counted[pixel]) {
                continue;
            }
            counted++;
            for (int i = 0; i < 3; i++) {
                sum[i] += plane[i] != NULL ? plane[i][pixel] : 0.0;
            }
        }
    }
    size_t tile = (size_t)row * (size_t)t->columns + (size_t)column;
    t->used[tile] = 2 * counted >= t->side * t->side;
    for (int i = 0; i < 3 && t->used[tile]; i++) {
        t->mean[i][tile] = sum[i] / counted;
    }
}

typedef struct {
    int pairs;
    double sum;     // of products of the difference, less those of the noise
    double squares; // of all products
} products;

static void multiply(const tiling *t, size_t a, size_t b, products *p)
{
    if (!t->used[a] || !t->used[b]) {
        return;
    }
    p->pairs++;
    for (int i = 0; i < 3; i++) {
        double product = t->mean[i][a] * t->mean[i][b];
        p->sum += i == 0 ? product : -product;
        p->squares += product * product;
    }
}

static products multiply_all(const tiling *t)
{
    products p = {0};
    for (int row = 0; row < t->rows; row++) {
        for (int column = 0; column < t->columns; column++) {
            size_t tile = (size_t)row * (size_t)t->columns + (size_t)column;
            if (column + GAP < t->columns) {
                multiply(t, tile, tile + GAP, &p);
            }
            if (row + GAP < t->rows) {
                multiply(t, tile, tile + GAP * (size_t)t->columns, &p);
            }
        }
    }
    return p;
}

pm_status pm_coherence_measure(const pm_coherence_planes *planes, pm_coherence *out)
{
    tiling t = {0};
    pm_status status = make_tiling(planes, &t);
    if (status == PM_OK) {
        for (int row = 0; row < t.rows; row++) {
            for (int column = 0; column < t.columns; column++) {
                average_tile(planes, column, row, &t);
            }
        }
        products p = multiply_all(&t);
        *out = (pm_coherence){.pairs = p.pairs};
        if (p.pairs > 0 && p.squares > 0.0) {
            out->z = p.sum / sqrt(p.squares);
            out->coherent = p.sum > 0.0 ? sqrt(p.sum / p.pairs) : 0.0;
        }
    }
    free_tiling(&t);
    return status;
}
