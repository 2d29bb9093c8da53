// Small pieces share blocks; a piece larger than a block gets one of its own.
//
// Invariant: the newest block is the one being filled, and `used` never passes `size`.
#include "arena.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK_BYTES = 65536 };

struct pm_arena_block {
    struct pm_arena_block *older;
    size_t size, used;
    max_align_t memory[];
};

static struct pm_arena_block *block_with_room(pm_arena *arena, size_t bytes)
{
    struct pm_arena_block *block = arena->blocks;
    if (block != NULL && block->size - block->used >= bytes) {
        return block;
    }
    size_t size = bytes > BLOCK_BYTES ? bytes : BLOCK_BYTES;
    block = calloc(1, sizeof *block + size);
    if (block == NULL) {
        return NULL;
    }
    block->size = size;
    block->older = arena->blocks;
    arena->blocks = block;
    return block;
}

void *pm_arena_take(pm_arena *arena, size_t count, size_t size)
{
    const size_t unit = sizeof(max_align_t);
    if (size != 0 && count > (SIZE_MAX / 2) / size) {
        return NULL;
    }
    size_t bytes = (count * size + unit - 1) / unit * unit;
    struct pm_arena_block *block = block_with_room(arena, bytes);
    if (block == NULL) {
        return NULL;
    }
    void *piece = (char *)block->memory + block->used;
    block->used += bytes;
    return piece;
}

char *pm_arena_copy(pm_arena *arena, const char *text, size_t length)
{
    char *copy = pm_arena_take(arena, length + 1, 1);
    if (copy != NULL) {
        memcpy(copy, text, length);
    }
    return copy;
}

char *pm_arena_print(pm_arena *arena, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    char *text = length < 0 ? NULL : pm_arena_take(arena, (size_t)length + 1, 1);
    if (text != NULL) {
        va_start(arguments, format);
        vsnprintf(text, (size_t)length + 1, format, arguments);
        va_end(arguments);
    }
    return text;
}

void pm_arena_free(pm_arena *arena)
{
    while (arena->blocks != NULL) {
        struct pm_arena_block *older = arena->blocks->older;
        free(arena->blocks);
        arena->blocks = older;
    }
}
