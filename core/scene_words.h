// The words of a scene file: which elements there are, where they may stand, which attributes
// they take; which plugins there are and which parameters those take. Tables and their lookup.
#ifndef PM_SCENE_WORDS_H
#define PM_SCENE_WORDS_H

#include <stdbool.h>

/// Kinds of parameters, as bits.
enum {
    PM_WORD_NUMBER = 1,  // <float> or <integer>
    PM_WORD_COUNT = 2,   // <integer>
    PM_WORD_SWITCH = 4,  // <boolean>
    PM_WORD_TEXT = 8,    // <string>
    PM_WORD_TRIPLE = 16, // <point> or <vector>
    PM_WORD_COLOUR = 32, // <rgb>, <spectrum> or <float>
    PM_WORD_PLACING = 64 // <transform>
};

/// One element name.
typedef struct {
    const char *tag;
    const char *inside;   // the tags it may stand in, separated by blanks
    const char *needs;    // attributes it must have
    const char *may_have; // attributes it may have besides
} pm_word_element;

typedef struct {
    const char *name;
    int kinds; // PM_WORD_...
    bool required;
} pm_word_parameter;

/// One `type` of an object.
typedef struct {
    const char *tag;
    const char *type;
    pm_word_parameter parameters[8]; // the last one has no name
} pm_word_plugin;

/// The row of the table, or NULL.
const pm_word_element *pm_scene_words_element(const char *tag);
const pm_word_plugin *pm_scene_words_plugin(const char *tag, const char *type);

/// The row of `name` among the parameters, or NULL.
const pm_word_parameter *pm_scene_words_parameter(const pm_word_plugin *plugin,
                                                  const char *name);

/// The nearest word, or NULL when there is none.
const char *pm_scene_words_nearest_element(const char *tag);
const char *pm_scene_words_nearest_plugin(const char *tag, const char *type);
const char *pm_scene_words_nearest_parameter(const pm_word_plugin *plugin, const char *name);

/// The kinds that a parameter written as <tag> has; 0 when `tag` is no parameter.
int pm_scene_words_kinds(const char *tag);

/// How parameters of these kinds are written: "a <float>" ...
const char *pm_scene_words_spelling(int kinds);

#endif
