// Words on the page, for what is drawn there beside panels.
#ifndef PM_WORDS_HH
#define PM_WORDS_HH

#include "figure.hh"

#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <string>

// Sizes of letters in a figure 900 pixels high.
const double pm_words_size = 19.0; // headings, labels, legends
const double pm_words_line = 31.0; // from a line to the next

/// Text whose top left corner is at (x, y), pixels from the bottom left; `size` in pixels.
/// @return its looks, to be changed
vtkTextProperty *pm_words_put(pm_figure *figure, const std::string &text, double x, double y,
                              double size);

/// The same, whole.
vtkTextActor *pm_words_actor(pm_figure *figure, const std::string &text, double x, double y,
                             double size);

/// How wide these letters of `size` pixels are, in pixels.
double pm_words_width(const std::string &text, double size);

#endif
