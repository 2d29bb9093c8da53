// Where things stand on a page: what title and right column leave free, and columns in it.
#include "figure.hh"

#include <cmath>

namespace {

const double margin = 24.0;  // pixels of a figure 900 high
const double caption = 36.0; // a line of text over a column

int whole(double pixels)
{
    return static_cast<int>(std::lround(pixels));
}

} // namespace

void pm_figure_size(const pm_figure *figure, int *width, int *height)
{
    *width = figure->width;
    *height = figure->height;
}

pm_rect pm_figure_room(const pm_figure *figure)
{
    int edge = whole(figure->pixels(margin));
    int top = whole(PM_VIEWPOINT_TOP * figure->height) + edge / 2;
    int right = whole((1.0 - PM_VIEWPOINT_RIGHT) * figure->width);
    return {edge, top, right - edge, figure->height - edge - top};
}

pm_rect pm_figure_wide_room(const pm_figure *figure)
{
    pm_rect room = pm_figure_room(figure);
    room.width = figure->width - 2 * room.x;
    return room;
}

void pm_figure_columns(const pm_figure *figure, const pm_rect *room, int count, pm_rect *cells)
{
    int gap = whole(figure->pixels(margin));
    int line = whole(figure->pixels(caption));
    int width = (room->width - gap * (count - 1)) / count;
    for (int i = 0; i < count; i++) {
        cells[i] = {room->x + i * (width + gap), room->y + line, width, room->height - line};
    }
}

double pm_figure_pixels_of(const pm_figure *figure, double at900)
{
    return figure->pixels(at900);
}
