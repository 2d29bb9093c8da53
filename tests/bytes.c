// A file that cannot be read or written ends the test.
#include "bytes.h"

#include "test.h"

#include <stdio.h>
#include <stdlib.h>

#define MOST (1u << 22)

uint8_t *pm_bytes_read(const char *path, size_t *size)
{
    FILE *stream = fopen(path, "rb");
    CHECK(stream != NULL);
    uint8_t *bytes = malloc(MOST);
    *size = fread(bytes, 1, MOST, stream);
    fclose(stream);
    return bytes;
}

void pm_bytes_write(const char *path, const uint8_t *bytes, size_t size)
{
    FILE *stream = fopen(path, "wb");
    CHECK(stream != NULL);
    CHECK(fwrite(bytes, 1, size, stream) == size);
    CHECK(fclose(stream) == 0);
}
