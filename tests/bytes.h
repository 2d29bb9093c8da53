// Whole files as bytes, for tests that cut and bend them.
#ifndef PM_BYTES_H
#define PM_BYTES_H

#include <stddef.h>
#include <stdint.h>

/// All bytes of a file of at most 4 MiB; the caller frees them.
uint8_t *pm_bytes_read(const char *path, size_t *size);
void pm_bytes_write(const char *path, const uint8_t *bytes, size_t size);

#endif
