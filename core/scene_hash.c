// Numbers are hashed as little-endian bytes, one by one: no padding, no pointers, so that the
// hash is the same on every machine. -0 counts as 0, since it means the same.
#include "scene_hash.h"

#include <string.h>

static uint64_t add_integer(uint64_t hash, uint64_t value)
{
    for (int i = 0; i < 8; i++) {
        hash ^= (value >> (8 * i)) & 0xff;
        hash *= 1099511628211u;
    }
    return hash;
}

static uint64_t add_number(uint64_t hash, double value)
{
    double positive_zero = value == 0.0 ? 0.0 : value;
    uint64_t bits;
    memcpy(&bits, &positive_zero, sizeof bits);
    return add_integer(hash, bits);
}

static uint64_t add_vector(uint64_t hash, pm_vec3 v)
{
    return add_number(add_number(add_number(hash, v.x), v.y), v.z);
}

static uint64_t add_spectrum(uint64_t hash, pm_spectrum s)
{
    return add_number(add_number(add_number(hash, s.c[0]), s.c[1]), s.c[2]);
}

static uint64_t add_glass(uint64_t hash, const pm_glass *glass)
{
    for (int i = 0; i < glass->terms; i++) {
        hash = add_number(add_number(hash, glass->b[i]), glass->c[i]);
    }
    return hash;
}

static uint64_t add_medium(uint64_t hash, const pm_scene *scene, int index)
{
    if (index == PM_NONE) {
        return add_integer(hash, UINT64_MAX);
    }
    const pm_medium *medium = &scene->media[index];
    hash = add_spectrum(add_number(hash, medium->sigma_t), medium->albedo);
    return add_number(hash, medium->g);
}

static uint64_t add_material(uint64_t hash, const pm_scene *scene, int index)
{
    if (index == PM_NONE) {
        return add_integer(hash, UINT64_MAX);
    }
    const pm_material *m = &scene->materials[index];
    hash = add_integer(hash, (uint64_t)m->type);
    hash = add_integer(hash, m->perfect_mirror);
    hash = add_spectrum(add_spectrum(hash, m->reflectance), m->specular_reflectance);
    hash = add_spectrum(hash, m->specular_transmittance);
    hash = add_number(add_number(hash, m->int_ior), m->ext_ior);
    hash = add_spectrum(add_spectrum(hash, m->eta), m->k);
    hash = add_number(add_integer(hash, (uint64_t)m->microfacet), m->alpha);
    return m->glass == NULL ? hash : add_glass(hash, m->glass);
}

static uint64_t add_mesh(uint64_t hash, const pm_shape *shape)
{
    hash = add_integer(add_integer(hash, shape->vertex_count), shape->triangle_count);
    for (uint32_t i = 0; i < shape->vertex_count; i++) {
        hash = add_vector(hash, shape->vertices[i]);
    }
    for (uint32_t i = 0; i < shape->triangle_count; i++) {
        const uint32_t *corner = shape->triangles[i];
        hash = add_integer(add_integer(add_integer(hash, corner[0]), corner[1]), corner[2]);
    }
    return hash;
}

static uint64_t add_shape(uint64_t hash, const pm_scene *scene, const pm_shape *shape)
{
    hash = add_integer(add_integer(hash, (uint64_t)shape->type), shape->flipped);
    hash = add_material(hash, scene, shape->material[0]);
    hash = add_material(hash, scene, shape->material[1]);
    hash =
        add_vector(add_vector(add_vector(hash, shape->corner), shape->edge[0]), shape->edge[1]);
    hash = add_vector(add_vector(hash, shape->center), shape->axis);
    hash = add_number(add_number(hash, shape->radius), shape->length);
    return add_mesh(hash, shape);
}

static uint64_t add_light(uint64_t hash, const pm_light *light)
{
    hash = add_integer(add_integer(hash, (uint64_t)light->type), (uint64_t)light->shape);
    hash = add_vector(add_vector(hash, light->position), light->direction);
    hash = add_number(add_number(hash, light->beam), light->cutoff);
    return add_spectrum(hash, light->emitted);
}

/// Nothing for a scene without media, so that its photon files stay valid.
static uint64_t add_media(uint64_t hash, const pm_scene *scene)
{
    if (scene->medium_count == 0) {
        return hash;
    }
    for (int i = 0; i < scene->shape_count; i++) {
        const pm_shape *shape = &scene->shapes[i];
        hash = add_integer(hash, shape->boundary);
        hash = add_medium(add_medium(hash, scene, shape->interior), scene, shape->exterior);
    }
    for (int i = 0; i < scene->light_count; i++) {
        hash = add_medium(hash, scene, scene->lights[i].medium);
    }
    return hash;
}

uint64_t pm_scene_hash(const pm_scene *scene)
{
    uint64_t hash = add_vector(14695981039346656037u, scene->center);
    for (int i = 0; i < scene->shape_count; i++) {
        hash = add_shape(hash, scene, &scene->shapes[i]);
    }
    for (int i = 0; i < scene->light_count; i++) {
        hash = add_light(hash, &scene->lights[i]);
    }
    return add_media(hash, scene);
}
