// A scene file as a tree of elements, read with expat. <default>, <include> and "$name" are
// done with here: the tree holds what they stand for. What the words mean is not known here.
//
// An instruction <?photonlab ...?> is an element too: its tag is PM_XML_INSTRUCTION, and its
// only attribute, "text", is what stands behind the first word.
//
// Invariant: every element keeps the file and line it was written at.
#ifndef PM_XML_H
#define PM_XML_H

#include "arena.h"
#include "faults.h"
#include "scene_read.h"

#define PM_XML_INSTRUCTION "?photonlab"
#define PM_XML_DEPTH_MAX 64   // elements inside each other
#define PM_XML_INCLUDE_MAX 16 // files inside each other
#define PM_XML_FILES_MAX 1000 // included in all

typedef struct pm_xml {
    const char *tag;
    const char *file;
    int line;
    const char **attributes; // name, value, name, value, ... NULL
    struct pm_xml *parent;
    struct pm_xml *child, *last; // first and last inside it
    struct pm_xml *next;         // behind it, in the same parent
    int index;                   // the reader's; PM_NONE at first
    int twin;                    // the reader's: earlier objects that would be called alike
} pm_xml;

/// What stands for an attribute's value when that has been reported as a fault already. Compare
/// the pointer.
extern const char pm_xml_faulty[];

/// Reads `path` and what it includes; the root is a <scene>.
///
/// Faults are added to `faults`: a file that cannot be read or is not well formed, an include
/// that is missing or includes itself, unknown $names, defines without a <default>, a document
/// type, text between elements, and an instruction outside the root.
///
/// @param arena  takes the tree
/// @return the root; NULL when there is none, and then there are faults
pm_xml *pm_xml_read(const char *path, const pm_define *defines, int define_count,
                    pm_arena *arena, pm_faults *faults);

/// The value of an attribute, or NULL.
const char *pm_xml_attribute(const pm_xml *element, const char *name);

/// The path of `name` as a file at `path` means it: from the folder of that file. Taken from
/// `arena`; NULL without memory.
const char *pm_xml_beside(pm_arena *arena, const char *path, const char *name);

/// Makes `element` the last one inside `parent`.
void pm_xml_append(pm_xml *parent, pm_xml *element);

/// The element after `element` in document order within `root`, or NULL.
pm_xml *pm_xml_following(const pm_xml *root, pm_xml *element);

#endif
