// The text in front of a photon file: what it says, printed and parsed.
//
// Invariant: one content has one text. A parsed header is printed again and compared, so that
// nothing in it can be altered without notice.
#ifndef PM_PHOTON_HEADER_H
#define PM_PHOTON_HEADER_H

#include "photon_file.h"

#include <stddef.h>

#define PM_PHOTON_HEADER_ROOM 4096

typedef struct {
    pm_photon_map map; // without its photons
    pm_photon_file_info info;
    bool has_bounce, has_light, has_path, has_normal;
    uint32_t crc; // of the whole file, with zeros in the place of its own digits
} pm_photon_header;

/// Bytes of a photon in the file.
size_t pm_photon_header_row(const pm_photon_header *header);

/// Prints the text, zero-terminated.
/// @param text  [out] room for PM_PHOTON_HEADER_ROOM
/// @return its length
size_t pm_photon_header_print(const pm_photon_header *header, char *text);

/// Where in a printed text the eight digits of the CRC begin.
size_t pm_photon_header_crc_at(const char *text);

/// Parses the beginning of a file.
///
/// @param path    for messages
/// @param text    zero-terminated after the bytes that were read; binary data may follow
/// @param header  [out]
/// @param length  [out] bytes of the text, with the newline after end_header
/// @return PM_EINPUT with a line that says what the file is instead
pm_status pm_photon_header_parse(const char *path, const char *text, pm_photon_header *header,
                                 size_t *length);

#endif
