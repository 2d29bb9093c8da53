// Ends and ticks of axes. Ticks stand at 1, 2 or 5 times a power of ten; a logarithmic axis
// names its decades, and more of them only where there is room.
#include "chart_axis.hh"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace {

const double rounding = 1e-9; // of an axis: ticks at its very ends are on it

/// The next of 1, 2, 5 times a power of ten.
double nice_step(double least)
{
    double power = std::pow(10.0, std::floor(std::log10(least)));
    double digit = least / power;
    return power * (digit <= 1.0 + rounding   ? 1.0
                    : digit <= 2.0 + rounding ? 2.0
                    : digit <= 5.0 + rounding ? 5.0
                                              : 10.0);
}

std::string group(const std::string &digits)
{
    std::string text;
    size_t whole = std::min(digits.find('.'), digits.size());
    size_t first = digits[0] == '-' ? 1 : 0;
    for (size_t i = 0; i < digits.size(); i++) {
        if (i > first && i < whole && (whole - i) % 3 == 0) {
            text += ',';
        }
        text += digits[i];
    }
    return text;
}

std::string as_power(double value)
{
    int exponent = static_cast<int>(std::floor(std::log10(std::fabs(value)) + rounding));
    char text[48];
    std::snprintf(text, sizeof text, "%.3ge%d", value / std::pow(10.0, exponent), exponent);
    return text;
}

std::vector<pm_chart_tick> linear_ticks(const pm_chart_axis &axis, double spacing)
{
    std::vector<pm_chart_tick> ticks;
    double step = nice_step(spacing * (axis.high - axis.low));
    double slack = rounding * (axis.high - axis.low);
    double first = std::ceil((axis.low - slack) / step);
    for (double i = first; i * step <= axis.high + slack; i += 1.0) {
        ticks.push_back({axis.at(i * step), pm_chart_number(i * step, step)});
    }
    return ticks;
}

/// Every value i * 10^e on the axis with a digit i in `digits`; labelled when i is in `named`
/// and e a multiple of `every`.
std::vector<pm_chart_tick> digits_of(const pm_chart_axis &axis, const std::string &digits,
                                     const std::string &named, int every)
{
    std::vector<pm_chart_tick> ticks;
    int last = static_cast<int>(std::ceil(std::log10(axis.high)));
    for (int e = static_cast<int>(std::floor(std::log10(axis.low))); e <= last; e++) {
        for (char digit : digits) {
            double value = (digit - '0') * std::pow(10.0, e);
            double at = axis.at(value);
            if (at >= -rounding && at <= 1.0 + rounding) {
                bool label = named.find(digit) != std::string::npos && e % every == 0;
                ticks.push_back({at, label ? pm_chart_number(value, value) : ""});
            }
        }
    }
    return ticks;
}

std::vector<pm_chart_tick> logarithmic_ticks(const pm_chart_axis &axis, double spacing)
{
    double decade = 1.0 / std::log10(axis.high / axis.low);
    if (decade < spacing) {
        return digits_of(axis, "1", "1", static_cast<int>(std::ceil(spacing / decade)));
    }
    bool room = decade * std::log10(2.0) >= spacing; // for a word at 1, 2 and 5
    const char *digits = decade > 2.0 * spacing ? "123456789" : "125";
    std::vector<pm_chart_tick> ticks = digits_of(axis, digits, room ? "125" : "1", 1);
    auto named = [](const pm_chart_tick &tick) { return !tick.text.empty(); };
    if (std::count_if(ticks.begin(), ticks.end(), named) < 2) {
        return linear_ticks(axis, spacing);
    }
    return ticks;
}

void fit_linear(pm_chart_axis *axis, double least, double most)
{
    if (least >= 0.0 && least <= 0.5 * most) {
        least = 0.0;
    }
    if (!(most > least)) {
        double some = least == 0.0 ? 1.0 : 0.1 * std::fabs(least);
        least -= least == 0.0 ? 0.0 : some;
        most += some;
    }
    double step = nice_step((most - least) / 8.0);
    axis->low = step * std::floor(least / step + rounding);
    axis->high = step * std::ceil(most / step - rounding);
}

void fit_logarithmic(pm_chart_axis *axis, double least, double most)
{
    double range = std::max(std::log10(most / least), 0.3);
    double beyond = std::pow(10.0, 0.07 * range);
    axis->low = least / beyond;
    axis->high = std::max(most, least * 1.5) * beyond;
}

} // namespace

std::string pm_chart_number(double value, double step)
{
    double size = std::fabs(value);
    if (size != 0.0 && (size >= 0.9999e7 || step < 0.9999e-4)) {
        return as_power(value);
    }
    int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - rounding)));
    char text[48];
    std::snprintf(text, sizeof text, "%.*f", decimals, value == 0.0 ? 0.0 : value);
    return group(text);
}

double pm_chart_axis::at(double value) const
{
    return log ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
}

void pm_chart_axis::fit(double least, double most)
{
    if (low != 0.0 || high != 0.0) {
        return;
    }
    if (!names.empty()) {
        low = -0.6;
        high = static_cast<double>(names.size()) - 0.4;
    } else if (log) {
        fit_logarithmic(this, least, most);
    } else {
        fit_linear(this, least, most);
    }
}

std::vector<pm_chart_tick> pm_chart_axis::ticks(double spacing) const
{
    std::vector<pm_chart_tick> ticks;
    if (names.empty()) {
        return log ? logarithmic_ticks(*this, spacing) : linear_ticks(*this, spacing);
    }
    for (size_t i = 0; i < names.size(); i++) {
        ticks.push_back({at(static_cast<double>(i)), names[i]});
    }
    return ticks;
}
