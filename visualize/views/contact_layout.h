// Measures of a contact sheet [pixels], for those who lay it out and who draw it.
#ifndef PM_CONTACT_LAYOUT_H
#define PM_CONTACT_LAYOUT_H

#include "contact.h"

enum {
    PM_CONTACT_MARGIN = 32,
    PM_CONTACT_TOP = 104,  // above the first row of blocks: title and note
    PM_CONTACT_GAP = 8,    // between pictures of a block
    PM_CONTACT_AISLE = 32, // between blocks
    PM_CONTACT_ABOVE = 30, // a block's heading
    PM_CONTACT_BELOW = 44, // a picture's setting and note
    PM_CONTACT_WIDTH_MIN = 720,
    // sizes of letters
    PM_CONTACT_TITLE = 28,
    PM_CONTACT_LEAD = 16, // the note under the title
    PM_CONTACT_HEADING = 19,
    PM_CONTACT_SETTING = 15,
    PM_CONTACT_NOTE = 13,
    PM_CONTACT_EXPOSURE_LETTERS = 10, // that the exposure takes beside a heading
    PM_CONTACT_SECONDS_LETTERS = 9,   // and the time beside a setting
};

#endif
