// The tree's own functions, for which no file is needed.
#include "xml.h"

#include <string.h>

const char pm_xml_faulty[] = "";

const char *pm_xml_attribute(const pm_xml *element, const char *name)
{
    for (const char **a = element->attributes; *a != NULL; a += 2) {
        if (strcmp(a[0], name) == 0) {
            return a[1];
        }
    }
    return NULL;
}

const char *pm_xml_beside(pm_arena *arena, const char *path, const char *name)
{
    const char *slash = strrchr(path, '/');
    int folder = name[0] == '/' || slash == NULL ? 0 : (int)(slash - path) + 1;
    return pm_arena_print(arena, "%.*s%s", folder, path, name);
}

void pm_xml_append(pm_xml *parent, pm_xml *element)
{
    element->parent = parent;
    if (parent->last == NULL) {
        parent->child = element;
    } else {
        parent->last->next = element;
    }
    parent->last = element;
}

pm_xml *pm_xml_following(const pm_xml *root, pm_xml *element)
{
    if (element->child != NULL) {
        return element->child;
    }
    while (element != root && element->next == NULL) {
        element = element->parent;
    }
    return element == root ? NULL : element->next;
}
