// Numbers written in a file: finite, in decimal, with nothing behind them.
#ifndef PM_NUMBER_H
#define PM_NUMBER_H

/// Reads the number that fills `text`; blanks around it are fine.
///
/// @param value  [out] untouched unless the result is NULL
/// @return NULL, or what is wrong, to follow the text in a message: "is not a number" ...
const char *pm_number_read(const char *text, double *value);

/// Reads up to `room` numbers separated by blanks or single commas.
///
/// @param values  [out] may be partly written on failure
/// @param count   [out] how many there were
/// @return NULL, or what is wrong
const char *pm_number_list(const char *text, double *values, int room, int *count);

#endif
