// A PLY file is a header of lines, then rows: one a line (ascii), or packed one after the
// other. Rows of a fixed size are stepped over at once; lists are walked.
#include "ply.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ELEMENTS_MAX = 16, PROPERTIES_MAX = 64, WORD = 32 };

typedef enum { ASCII, LITTLE_ENDIAN_BINARY, BIG_ENDIAN_BINARY } encoding;

typedef struct {
    unsigned count_bytes; // of a list's length; 0: not a list
    unsigned bytes;       // of one value
} property;

typedef struct {
    char name[WORD];
    uint64_t rows;
    property properties[PROPERTIES_MAX];
    int property_count;
} element;

typedef struct {
    encoding form;
    bool formed; // it said so
    bool ours;   // written by photonlab: photons
    element elements[ELEMENTS_MAX];
    int element_count;
} header;

static unsigned bytes_of(const char *type)
{
    static const struct {
        const char *type;
        unsigned bytes;
    } known[] = {{"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},
                 {"short", 2}, {"ushort", 2},  {"int16", 2},  {"uint16", 2},
                 {"int", 4},   {"uint", 4},    {"int32", 4},  {"uint32", 4},
                 {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        if (strcmp(known[i].type, type) == 0) {
            return known[i].bytes;
        }
    }
    return 0;
}

static const char *read_element(const char *line, header *h)
{
    char rows[WORD];
    if (h->element_count == ELEMENTS_MAX) {
        return "has too many kinds of elements";
    }
    element *e = &h->elements[h->element_count++];
    if (sscanf(line, "element %31s %31s", e->name, rows) != 2 ||
        strspn(rows, "0123456789") != strlen(rows) || strlen(rows) > 10) {
        return "has an element without a count";
    }
    e->rows = strtoull(rows, NULL, 10);
    return NULL;
}

static const char *read_property(const char *line, header *h)
{
    char type[WORD];
    char count[WORD];
    if (h->element_count == 0) {
        return "has a property before its first element";
    }
    element *e = &h->elements[h->element_count - 1];
    if (e->property_count == PROPERTIES_MAX) {
        return "has too many properties";
    }
    property *p = &e->properties[e->property_count++];
    if (sscanf(line, "property list %31s %31s", count, type) == 2) {
        p->count_bytes = bytes_of(count);
        if (p->count_bytes == 0 || p->count_bytes == 8) {
            return "has a list whose length is of no integer type";
        }
    } else if (sscanf(line, "property %31s", type) != 1) {
        return "has a property without a type";
    }
    p->bytes = bytes_of(type);
    return p->bytes == 0 ? "has a property of unknown type" : NULL;
}

static const char *read_format(const char *line, header *h)
{
    static const char *const known[3] = {"ascii", "binary_little_endian", "binary_big_endian"};
    char name[WORD];
    char version[WORD];
    if (sscanf(line, "format %31s %31s", name, version) == 2 && strcmp(version, "1.0") == 0) {
        for (int i = 0; i < 3; i++) {
            if (strcmp(name, known[i]) == 0) {
                h->form = (encoding)i;
                h->formed = true;
                return NULL;
            }
        }
    }
    return "has a format that is not ascii or binary of version 1.0";
}

static const char *read_comment(const char *line, header *h)
{
    char word[WORD] = "";
    sscanf(line, "comment %31s", word);
    h->ours = h->ours || strcmp(word, "photonlab") == 0;
    return NULL;
}

static const char *pass_over(const char *line, header *h)
{
    (void)line;
    (void)h;
    return NULL;
}

static const char *read_line(const char *line, header *h)
{
    static const struct {
        const char *word;
        const char *(*read)(const char *line, header *h);
    } known[] = {{"format ", read_format},
                 {"comment", read_comment},
                 {"obj_info", pass_over},
                 {"element ", read_element},
                 {"property ", read_property}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        if (strncmp(line, known[i].word, strlen(known[i].word)) == 0) {
            return known[i].read(line, h);
        }
    }
    // Assimp never comes back from some headers with other words in them.
    return "has a header line that is none of PLY";
}

/// Reads the header; `body` becomes where the rows begin.
static const char *read_header(const char *bytes, header *h, const char **body)
{
    if (strncmp(bytes, "ply\n", 4) != 0 && strncmp(bytes, "ply\r\n", 5) != 0) {
        return "is not a PLY file: it must begin with \"ply\"";
    }
    for (const char *line = strchr(bytes, '\n') + 1;; line = strchr(line, '\n') + 1) {
        if (strchr(line, '\n') == NULL) {
            return "is cut short: its header has no end_header";
        }
        if (strncmp(line, "end_header\n", 11) == 0 ||
            strncmp(line, "end_header\r\n", 12) == 0) {
            *body = strchr(line, '\n') + 1;
            return h->formed ? NULL : "has no format";
        }
        const char *wrong = read_line(line, h);
        if (wrong != NULL) {
            return wrong;
        }
    }
}

static bool lines_are_there(const header *h, const char *body)
{
    uint64_t rows = 0;
    uint64_t lines = 0;
    for (int i = 0; i < h->element_count; i++) {
        rows += h->elements[i].rows;
    }
    for (const char *line = body; *line != '\0' && lines < rows;) {
        size_t length = strcspn(line, "\n");
        lines += strspn(line, " \t\r") < length;
        line += length + (line[length] == '\n');
    }
    return lines == rows;
}

static uint64_t list_length(const unsigned char *at, unsigned bytes, encoding form)
{
    uint64_t length = 0;
    for (unsigned i = 0; i < bytes; i++) {
        unsigned from = form == BIG_ENDIAN_BINARY ? i : bytes - 1 - i;
        length = length << 8 | at[from];
    }
    return length;
}

/// Steps over one row; false when it does not end before the file does.
static bool skip_row(const element *e, encoding form, const char **at, const char *end)
{
    for (int i = 0; i < e->property_count; i++) {
        const property *p = &e->properties[i];
        uint64_t values = 1;
        if ((uint64_t)(end - *at) < p->count_bytes) {
            return false;
        }
        if (p->count_bytes > 0) {
            values = list_length((const unsigned char *)*at, p->count_bytes, form);
            *at += p->count_bytes;
        }
        if ((uint64_t)(end - *at) / p->bytes < values) {
            return false;
        }
        *at += values * p->bytes;
    }
    return true;
}

static bool rows_are_there(const header *h, const char *body, const char *end)
{
    for (int i = 0; i < h->element_count; i++) {
        const element *e = &h->elements[i];
        if (e->property_count == 0 && e->rows > 0) {
            return false;
        }
        for (uint64_t row = 0; row < e->rows; row++) {
            if (!skip_row(e, h->form, &body, end)) {
                return false;
            }
        }
    }
    return true;
}

static uint64_t rows_of(const header *h, const char *name)
{
    for (int i = 0; i < h->element_count; i++) {
        if (strcmp(h->elements[i].name, name) == 0) {
            return h->elements[i].rows;
        }
    }
    return 0;
}

const char *pm_ply_check(const char *bytes, size_t size, pm_ply *ply)
{
    header h = {0};
    const char *body;
    const char *wrong = read_header(bytes, &h, &body);
    if (wrong != NULL) {
        return wrong;
    }
    pm_ply counts = {rows_of(&h, "vertex"), rows_of(&h, "face")};
    if (counts.faces == 0 && h.ours) {
        return "is a photon file, not a mesh";
    }
    if (counts.faces == 0 || counts.vertices == 0) {
        return "holds points without faces, such as a photon file: not a mesh";
    }
    if (h.form == ASCII ? !lines_are_there(&h, body)
                        : !rows_are_there(&h, body, bytes + size)) {
        return "is cut short: rows that its header promises are missing";
    }
    *ply = counts;
    return NULL;
}
