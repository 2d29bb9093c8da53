// balancing: the photons of a scene become a kd-tree, and the k nearest are looked up in it.
//
// For comparison the same photons also go into a tree that grows by itself: inserted one by one
// in the order they were stored, axes taking turns by depth.
#include "balance.h"
#include "clock.h"
#include "map_make.h"
#include "photon_file.h"
#include "photon_map.h"
#include "program.h"
#include "report.h"
#include "world.h"

#include <stdio.h>
#include <stdlib.h>

#define QUERIES 2000u // photons around which is searched, spread evenly over the map
#define NO_CHILD UINT32_MAX

static const pm_options_program program = {
    .name = "balancing",
    .does = "Builds the kd-tree of a scene's global photon map and measures searches in it.",
    .positional = "SCENE",
    .positional_least = 1,
    .positional_most = 1,
    .options = "n projection k r roulette max-bounces packing o report",
    .notes =
        "-o writes the balanced map. Searches are around photons of the map, without side\n"
        "test. height counts the links from the root to the deepest photon; unbalanced is\n"
        "a tree that photons are inserted into as they come. Of a scene with media the global\n"
        "map is taken, too: trees of volume maps are made the same way.",
};

typedef struct {
    const pm_options *options;
    pm_world world;
    pm_photon_map map;
    pm_vec3 *queries;
    uint32_t query_count;
    double visited, visited_unbalanced; // means
    double build_s, query_s;            // CPU
} pm_job;

// --- the tree that grows by itself ----------------------------------------------------------

typedef struct {
    const pm_photon *photons;
    uint32_t (*child)[2]; // of photon i; photon 0 is the root
    uint32_t height;
} grown_tree;

/// Goes down from photon `node`; true when `at` lies beyond it.
static bool side_of(const pm_photon *photon, pm_vec3 at, uint32_t depth)
{
    int axis = (int)(depth % 3);
    return pm_vec_axis(at, axis) > (double)photon->position[axis];
}

static pm_vec3 position_of(const pm_photon *photon)
{
    return pm_vec((double)photon->position[0], (double)photon->position[1],
                  (double)photon->position[2]);
}

static void insert(grown_tree *tree, uint32_t photon)
{
    pm_vec3 at = position_of(&tree->photons[photon]);
    uint32_t node = 0;
    uint32_t depth = 0;
    for (;;) {
        bool side = side_of(&tree->photons[node], at, depth);
        depth++;
        if (tree->child[node][side] == NO_CHILD) {
            tree->child[node][side] = photon;
            break;
        }
        node = tree->child[node][side];
    }
    tree->height = depth > tree->height ? depth : tree->height;
}

static pm_status grow(const pm_photon_map *map, grown_tree *tree)
{
    *tree = (grown_tree){.photons = map->photons};
    tree->child = malloc((size_t)map->count * sizeof *tree->child);
    if (tree->child == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for a tree of %u photons", map->count);
    }
    for (uint32_t i = 0; i < map->count; i++) {
        tree->child[i][0] = tree->child[i][1] = NO_CHILD;
    }
    for (uint32_t i = 1; i < map->count; i++) {
        insert(tree, i);
    }
    return PM_OK;
}

/// The distances held: a max-heap once there are k.
typedef struct {
    double *distance2;
    uint32_t k, found;
} distances;

static void replace_farthest(distances *held, double distance2)
{
    double *heap = held->distance2;
    uint64_t hole = 0;
    for (;;) {
        uint64_t child = 2 * hole + 1;
        if (child + 1 < held->k && heap[child + 1] > heap[child]) {
            child++;
        }
        if (child >= held->k || heap[child] <= distance2) {
            break;
        }
        heap[hole] = heap[child];
        hole = child;
    }
    heap[hole] = distance2;
}

static void append(distances *held, double distance2)
{
    uint32_t at = held->found++;
    while (at > 0 && held->distance2[(at - 1) / 2] < distance2) {
        held->distance2[at] = held->distance2[(at - 1) / 2];
        at = (at - 1) / 2;
    }
    held->distance2[at] = distance2;
}

typedef struct {
    uint32_t node, depth;
    double plane2;
} put_off;

/// The same search as pm_balance_nearest(), in this tree. Returns the nodes looked at.
static uint64_t visits(const grown_tree *tree, pm_vec3 at, double reach2, distances *held,
                       put_off *later)
{
    uint64_t looked_at = 0;
    uint32_t waiting = 0;
    later[waiting++] = (put_off){0, 0, 0.0};
    held->found = 0;
    while (waiting > 0) {
        put_off next = later[--waiting];
        double limit = held->found == held->k ? held->distance2[0] : reach2;
        if (next.node == NO_CHILD || next.plane2 > limit) {
            continue;
        }
        looked_at++;
        const pm_photon *photon = &tree->photons[next.node];
        pm_vec3 away = pm_vec_sub(position_of(photon), at);
        double distance2 = pm_vec_dot(away, away);
        if (distance2 <= limit && held->found == held->k) {
            replace_farthest(held, distance2);
        } else if (distance2 <= limit) {
            append(held, distance2);
        }
        double plane = pm_vec_axis(away, (int)(next.depth % 3));
        bool side = side_of(photon, at, next.depth);
        later[waiting++] =
            (put_off){tree->child[next.node][!side], next.depth + 1, plane * plane};
        later[waiting++] = (put_off){tree->child[next.node][side], next.depth + 1, 0.0};
    }
    return looked_at;
}

static pm_status measure_grown(pm_job *job, const grown_tree *tree)
{
    const pm_estimate_settings *settings = &job->options->estimate;
    distances held = {.k = settings->k};
    held.distance2 = malloc((size_t)settings->k * sizeof *held.distance2);
    put_off *later = malloc(((size_t)tree->height + 2) * 2 * sizeof *later);
    uint64_t visited = 0;
    if (held.distance2 != NULL && later != NULL) {
        for (uint32_t i = 0; i < job->query_count; i++) {
            double reach2 = settings->radius * settings->radius;
            visited += visits(tree, job->queries[i], reach2, &held, later);
        }
    }
    bool made = held.distance2 != NULL && later != NULL;
    free(held.distance2);
    free(later);
    job->visited_unbalanced = (double)visited / job->query_count;
    return made ? PM_OK : PM_FAIL(PM_ENOMEM, "no memory to search for %u photons", settings->k);
}

// --- the balanced tree ----------------------------------------------------------------------

static pm_status measure_balanced(pm_job *job)
{
    const pm_estimate_settings *settings = &job->options->estimate;
    pm_neighbour *nearest = malloc((size_t)settings->k * sizeof *nearest);
    if (nearest == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory to search for %u photons", settings->k);
    }
    pm_status status = PM_OK;
    uint64_t visited = 0;
    double start = pm_cpu_seconds_now();
    for (uint32_t i = 0; i < job->query_count && status == PM_OK; i++) {
        uint32_t found;
        pm_search search = {.at = job->queries[i],
                            .k = settings->k,
                            .radius2 = settings->radius * settings->radius};
        status = pm_balance_nearest(&job->map, &search, nearest, &found, &visited);
    }
    job->query_s = pm_cpu_seconds_now() - start;
    job->visited = (double)visited / job->query_count;
    free(nearest);
    return status;
}

// --- the job --------------------------------------------------------------------------------

static pm_status choose_queries(pm_job *job)
{
    uint32_t count = job->map.count < QUERIES ? job->map.count : QUERIES;
    job->queries = malloc((size_t)count * sizeof *job->queries + 1);
    if (job->queries == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for %u searches", count);
    }
    for (uint32_t i = 0; i < count; i++) {
        uint64_t photon = (uint64_t)i * job->map.count / count;
        job->queries[i] = position_of(&job->map.photons[photon]);
    }
    job->query_count = count;
    return PM_OK;
}

static pm_status compare_with_grown(pm_job *job)
{
    grown_tree tree;
    pm_status status = grow(&job->map, &tree);
    if (status == PM_OK) {
        status = measure_grown(job, &tree);
    }
    free(tree.child);
    return status;
}

static pm_status build(pm_job *job)
{
    double start = pm_cpu_seconds_now();
    PM_TRY(pm_balance_build(&job->map));
    job->build_s = pm_cpu_seconds_now() - start;
    return PM_OK;
}

static int height_of(uint32_t count)
{
    int height = 0;
    while (count >> (height + 1) > 0) {
        height++;
    }
    return height;
}

static pm_status report(const pm_job *job)
{
    uint32_t count = job->map.count;
    double rate = job->query_s > 0.0 ? job->query_count / job->query_s : 0.0;
    if (!job->options->json) {
        printf("%-34s %14u\n", "photons", count);
        printf("%-34s %14d\n", "height of the tree", height_of(count));
        printf("%-34s %14.3f\n", "seconds to build it (CPU)", job->build_s);
        printf("%-34s %14.1f\n", "photons looked at in a search", job->visited);
        printf("%-34s %14.1f\n", "the same in a tree not balanced", job->visited_unbalanced);
        printf("%-34s %14.0f\n", "searches a second (one thread)", rate);
    }
    json_t *object =
        json_pack("{s:I,s:i,s:f,s:f,s:f,s:f}", "photons", (json_int_t)count, "height",
                  height_of(count), "build_s", job->build_s, "visited_mean", job->visited,
                  "visited_mean_unbalanced", job->visited_unbalanced, "queries_per_s", rate);
    object = pm_report_add(object, "notes", pm_report_notes(&job->world.scene));
    return pm_report_end(job->options, object);
}

static pm_status write_map(const pm_job *job)
{
    const pm_scene *scene = &job->world.scene;
    pm_photon_file_info info = {job->options->seed, scene->hash, scene->center};
    return pm_photon_file_write(job->options->output, &job->map, &info, NULL);
}

static pm_status trace(pm_job *job)
{
    pm_projections aim;
    PM_TRY(pm_map_aim(job->options, &job->world.scene, PM_MAP_GLOBAL, &aim));
    pm_pass_settings settings = pm_map_settings(job->options, PM_MAP_GLOBAL, 0);
    settings.projections = pm_projection_of(&aim);
    pm_status status =
        pm_photon_pass(&job->world.rays, PM_MAP_GLOBAL, &settings, &job->map, NULL);
    pm_projection_free(&aim);
    return status;
}

static pm_status run(pm_job *job)
{
    const pm_options *options = job->options;
    PM_TRY(pm_world_open(options, false, &job->world));
    PM_TRY(trace(job));
    if (job->map.count > 0) {
        PM_TRY(choose_queries(job));
        PM_TRY(compare_with_grown(job));
    }
    PM_TRY(build(job));
    if (job->map.count > 0) {
        PM_TRY(measure_balanced(job));
    }
    if (options->output != NULL) {
        PM_TRY(write_map(job));
    }
    return report(job);
}

int main(int argc, char **argv)
{
    pm_options options;
    int code;
    if (!pm_program_start(argc, argv, &program, &options, &code)) {
        return code;
    }
    pm_job job = {.options = &options};
    pm_status status = run(&job);
    free(job.queries);
    pm_photon_map_free(&job.map);
    pm_world_close(&job.world);
    return pm_program_end(status);
}
