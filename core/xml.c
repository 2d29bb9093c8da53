// expat calls begin(), end() ... as it goes through a file; an include is read in the middle of
// that, into the element that is open, so $names see exactly the defaults that stand before
// them.
#include "xml.h"

#include "defaults.h"

#include <errno.h>
#include <expat.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/// What all files of one scene share.
typedef struct {
    pm_arena *arena;
    pm_faults *faults;
    pm_defaults defaults;
    int files;   // included so far
    bool broken; // a fault after which nothing more can be read
} reading;

/// One file being read, inside the one that includes it.
typedef struct layer {
    reading *all;
    const struct layer *outer;
    XML_Parser parser;
    const char *path;
    dev_t device;
    ino_t node;
    int level;                      // of includes
    int include_line;               // in `outer`
    pm_xml *root;                   // this file's <scene>, when it has been met
    pm_xml *into;                   // takes the root's children instead of it; NULL: the root
    pm_xml *open[PM_XML_DEPTH_MAX]; // elements whose end is still to come
    int depth;                      // how many
    const pm_xml *text_in;          // where stray text was last found
} layer;

static void read_file(layer *file);

static int line_of(const layer *file)
{
    return (int)XML_GetCurrentLineNumber(file->parser);
}

#define FAULT(file, ...)                                                                       \
    pm_faults_add((file)->all->faults, (file)->path, line_of(file), __VA_ARGS__)

static void stop(const layer *file)
{
    file->all->broken = true;
    XML_StopParser(file->parser, XML_FALSE);
}

static void stop_without_memory(const layer *file)
{
    pm_faults_fail(file->all->faults, PM_ENOMEM);
    stop(file);
}

/// `text` with its $names replaced; NULL without memory.
static const char *replaced(const layer *file, const char *text)
{
    const char *result;
    const char *unknown;
    if (pm_defaults_replace(&file->all->defaults, file->all->arena, text, &result, &unknown) !=
        PM_OK) {
        return NULL;
    }
    if (unknown != NULL) {
        pm_defaults_report_unknown(&file->all->defaults, unknown, file->all->faults, file->path,
                                   line_of(file));
        return pm_xml_faulty;
    }
    return result;
}

static const char **own_attributes(const layer *file, const char **given)
{
    size_t count = 0;
    while (given[count] != NULL) {
        count++;
    }
    const char **own = pm_arena_take(file->all->arena, count + 1, sizeof *own);
    for (size_t i = 0; own != NULL && i < count; i += 2) {
        own[i] = pm_arena_copy(file->all->arena, given[i], strlen(given[i]));
        own[i + 1] = replaced(file, given[i + 1]);
        if (own[i] == NULL || own[i + 1] == NULL) {
            return NULL;
        }
    }
    return own;
}

/// The value of `name`; a fault without it, and at attributes but it and `other`.
static const char *only_attribute(const layer *file, const pm_xml *element, const char *name,
                                  const char *other)
{
    for (const char **a = element->attributes; *a != NULL; a += 2) {
        if (strcmp(a[0], name) != 0 && strcmp(a[0], other) != 0) {
            FAULT(file, "<%s> takes no attribute \"%.60s\"", element->tag, a[0]);
        }
    }
    const char *value = pm_xml_attribute(element, name);
    if (value == NULL || *value == '\0') {
        FAULT(file, "<%s> needs the attribute \"%s\"", element->tag, name);
        return NULL;
    }
    return value;
}

static void give_default(const layer *file, const pm_xml *element)
{
    const char *name = only_attribute(file, element, "name", "value");
    const char *value = pm_xml_attribute(element, "value");
    if (value == NULL) {
        FAULT(file, "<default> needs the attribute \"value\"");
    } else if (name != NULL &&
               pm_defaults_give(&file->all->defaults, file->all->arena, name, value) != PM_OK) {
        stop_without_memory(file);
    }
}

static void include(layer *file, const pm_xml *element)
{
    const char *name = only_attribute(file, element, "filename", "filename");
    if (name == NULL) {
        return;
    }
    if (file->level == PM_XML_INCLUDE_MAX || file->all->files == PM_XML_FILES_MAX) {
        FAULT(file, "too many includes: at most %d inside each other and %d in all",
              PM_XML_INCLUDE_MAX, PM_XML_FILES_MAX);
        stop(file);
        return;
    }
    layer *inner = calloc(1, sizeof *inner);
    const char *path = pm_xml_beside(file->all->arena, file->path, name);
    if (inner == NULL || path == NULL) {
        free(inner);
        stop_without_memory(file);
        return;
    }
    file->all->files++;
    *inner = (layer){.all = file->all, .outer = file, .path = path, .level = file->level + 1};
    inner->include_line = line_of(file);
    inner->into = element->parent;
    read_file(inner);
    free(inner);
    if (file->all->broken) {
        stop(file);
    }
}

/// NULL without memory, and then reading stops.
static pm_xml *new_element(const layer *file, const char *tag, const char **attributes)
{
    pm_xml *element = pm_arena_take(file->all->arena, 1, sizeof *element);
    if (element == NULL) {
        stop_without_memory(file);
        return NULL;
    }
    element->tag = pm_arena_copy(file->all->arena, tag, strlen(tag));
    element->attributes = own_attributes(file, attributes);
    element->file = file->path;
    element->line = line_of(file);
    element->index = PM_NONE;
    if (element->tag != NULL && element->attributes != NULL) {
        return element;
    }
    stop_without_memory(file);
    return NULL;
}

static void check_root(layer *file, pm_xml *element)
{
    file->root = element;
    const char *version = pm_xml_attribute(element, "version");
    if (strcmp(element->tag, "scene") != 0) {
        FAULT(file, "a scene file begins with <scene version=\"3.0.0\">, not with <%.60s>",
              element->tag);
        stop(file);
    } else if (version == NULL) {
        FAULT(file, "<scene> needs the attribute \"version\", such as \"3.0.0\"");
    } else if ((version[0] != '2' && version[0] != '3') ||
               (version[1] != '.' && version[1] != '\0')) {
        FAULT(file, "scenes of version 2 or 3 are read, this one has version \"%.60s\"",
              version);
    }
}

/// Takes its place in the tree, or is done with here; NULL was reported.
static void place(layer *file, pm_xml *element)
{
    if (element == NULL) {
        return;
    }
    if (file->depth == 0) {
        check_root(file, element);
        return;
    }
    pm_xml *parent = file->open[file->depth - 1];
    if (file->depth == 1 && file->into != NULL) {
        parent = file->into;
    }
    element->parent = parent;
    if (strcmp(parent->tag, "default") == 0 || strcmp(parent->tag, "include") == 0) {
        FAULT(file, "nothing can stand inside <%s>", parent->tag);
    } else if (strcmp(element->tag, "default") == 0) {
        give_default(file, element);
    } else if (strcmp(element->tag, "include") == 0) {
        include(file, element);
    } else {
        pm_xml_append(parent, element);
    }
}

static void XMLCALL begin(void *context, const XML_Char *tag, const XML_Char **attributes)
{
    layer *file = context;
    if (file->depth == PM_XML_DEPTH_MAX) {
        FAULT(file, "more than %d elements inside each other", PM_XML_DEPTH_MAX);
        stop(file);
        return;
    }
    pm_xml *element = new_element(file, tag, attributes);
    place(file, element);
    file->open[file->depth] = element;
    file->depth += element != NULL;
}

static void XMLCALL end(void *context, const XML_Char *tag)
{
    (void)tag;
    layer *file = context;
    // A parser that was told to stop may still report the end of the element it stopped in.
    file->depth -= file->depth > 0;
}

static void XMLCALL text(void *context, const XML_Char *bytes, int length)
{
    layer *file = context;
    const pm_xml *inside = file->open[file->depth - 1];
    for (int i = 0; i < length && file->text_in != inside; i++) {
        if (strchr(" \t\r\n", bytes[i]) == NULL) {
            FAULT(file, "text \"%.*s\" inside <%s>: values stand in attributes",
                  length - i < 40 ? length - i : 40, bytes + i, inside->tag);
            file->text_in = inside;
        }
    }
}

static void XMLCALL instruction(void *context, const XML_Char *target, const XML_Char *data)
{
    layer *file = context;
    bool ours = strcmp(target, "photonlab") == 0;
    if (ours && file->depth == 0) {
        FAULT(file, "<?photonlab %.60s?> stands outside <scene>", data);
    } else if (ours) {
        const char *attributes[] = {"text", data, NULL};
        place(file, new_element(file, PM_XML_INSTRUCTION, attributes));
    }
}

static void XMLCALL document_type(void *context, const XML_Char *name, const XML_Char *system,
                                  const XML_Char *public, int internal)
{
    (void)name;
    (void)system;
    (void)public;
    (void)internal;
    const layer *file = context;
    FAULT(file, "a document type is not read: leave out <!DOCTYPE ...> and its entities");
    stop(file);
}

/// A fault about the file as a whole: at the include that names it, or about the path itself.
static void report_unreadable(const layer *file, const char *why)
{
    pm_faults *faults = file->all->faults;
    file->all->broken = true;
    if (file->outer != NULL) {
        pm_faults_add(faults, file->outer->path, file->include_line,
                      "included file \"%.120s\" %s", file->path, why);
    } else {
        pm_faults_add(faults, file->path, 0, "%s", why);
        pm_faults_fail(faults, PM_EIO);
    }
}

/// Why an opened file is not to be read, or NULL.
static const char *judge(layer *file, FILE *stream)
{
    struct stat about;
    if (fstat(fileno(stream), &about) != 0) {
        return "cannot be read";
    }
    file->device = about.st_dev;
    file->node = about.st_ino;
    for (const layer *l = file->outer; l != NULL; l = l->outer) {
        if (l->device == file->device && l->node == file->node) {
            return "includes itself";
        }
    }
    return S_ISDIR(about.st_mode) ? "is a folder, not a scene file" : NULL;
}

static FILE *open_file(layer *file)
{
    FILE *stream = fopen(file->path, "rb");
    if (stream == NULL) {
        char why[120];
        snprintf(why, sizeof why, "cannot be read: %s", strerror(errno));
        report_unreadable(file, why);
        return NULL;
    }
    const char *why = judge(file, stream);
    if (why != NULL) {
        report_unreadable(file, why);
        fclose(stream);
        return NULL;
    }
    return stream;
}

static void report_parser(const layer *file)
{
    enum XML_Error error = XML_GetErrorCode(file->parser);
    file->all->broken = true;
    if (error == XML_ERROR_NO_MEMORY) {
        pm_faults_fail(file->all->faults, PM_ENOMEM);
    } else if (error == XML_ERROR_NO_ELEMENTS && XML_GetCurrentByteCount(file->parser) == 0 &&
               XML_GetCurrentByteIndex(file->parser) <= 0) {
        FAULT(file, "the file is empty, not a scene");
    } else if (error != XML_ERROR_ABORTED) {
        FAULT(file, "not well-formed XML: %s", XML_ErrorString(error));
    }
}

static void parse(layer *file, FILE *stream)
{
    char bytes[16384];
    size_t length;
    do {
        length = fread(bytes, 1, sizeof bytes, stream);
        if (ferror(stream)) {
            report_unreadable(file, "cannot be read to its end");
            return;
        }
        if (XML_Parse(file->parser, bytes, (int)length, length == 0) == XML_STATUS_ERROR) {
            report_parser(file);
            return;
        }
    } while (length > 0);
}

static void read_file(layer *file)
{
    FILE *stream = open_file(file);
    if (stream == NULL) {
        return;
    }
    file->parser = XML_ParserCreate(NULL);
    if (file->parser == NULL) {
        pm_faults_fail(file->all->faults, PM_ENOMEM);
        file->all->broken = true;
    } else {
        XML_SetUserData(file->parser, file);
        XML_SetElementHandler(file->parser, begin, end);
        XML_SetCharacterDataHandler(file->parser, text);
        XML_SetProcessingInstructionHandler(file->parser, instruction);
        XML_SetStartDoctypeDeclHandler(file->parser, document_type);
        parse(file, stream);
        XML_ParserFree(file->parser);
    }
    fclose(stream);
}

pm_xml *pm_xml_read(const char *path, const pm_define *defines, int define_count,
                    pm_arena *arena, pm_faults *faults)
{
    reading all = {arena, faults, {defines, define_count, NULL}, 0, false};
    layer *file = calloc(1, sizeof *file);
    const char *own_path = pm_arena_copy(arena, path, strlen(path));
    if (file == NULL || own_path == NULL) {
        free(file);
        pm_faults_fail(faults, PM_ENOMEM);
        return NULL;
    }
    *file = (layer){.all = &all, .path = own_path};
    read_file(file);
    pm_xml *root = all.broken ? NULL : file->root;
    free(file);
    if (root != NULL) {
        pm_defaults_report_unused(&all.defaults, faults, own_path);
    }
    return root;
}
