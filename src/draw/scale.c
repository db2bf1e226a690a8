#include "draw/scale.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SAMPLE_MOST = 1 << 16 }; /* values that are sorted; of more, every few */

floe_status scale_sample_add(scale_sample *sample, context *ctx, const double *value, size_t n)
{
    const size_t every = n / SAMPLE_MOST + 1;
    const size_t capacity = sample->n + n / every + 1;
    TRY(memory_resize(ctx, &sample->value, capacity, sizeof *sample->value));
    sample->capacity = capacity;
    for (size_t i = 0; i < n; i++) {
        if (!isfinite(value[i])) continue;
        sample->least = sample->met == 0 ? value[i] : fmin(sample->least, value[i]);
        sample->most = sample->met == 0 ? value[i] : fmax(sample->most, value[i]);
        sample->met++;
        if (i % every == 0) sample->value[sample->n++] = value[i];
    }
    return FLOE_OK;
}

void scale_sample_free(scale_sample *sample, context *ctx)
{
    memory_free(ctx, &sample->value);
    *sample = (scale_sample){0};
}

static int compare_values(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The largest 1, 2 or 5 times a power of ten that is not above x > 0. */
static double round_below(double x)
{
    const double power = pow(10.0, floor(log10(x)));
    const double m = x / power * (1.0 + 1e-12);
    return power * (m >= 5.0 ? 5.0 : m >= 2.0 ? 2.0 : 1.0);
}

/* The smallest that is not below x > 0. */
static double round_above(double x)
{
    const double power = pow(10.0, floor(log10(x)));
    const double m = x / power * (1.0 - 1e-12);
    return power * (m <= 1.0 ? 1.0 : m <= 2.0 ? 2.0 : m <= 5.0 ? 5.0 : 10.0);
}

/* The range without the few at the ends, if those would take more than half of it. */
static void choose_range(scale *s, scale_sample *sample)
{
    s->lower = sample->least;
    s->upper = sample->most;
    if (sample->n == 0) return;
    qsort(sample->value, sample->n, sizeof *sample->value, compare_values);
    const size_t few = sample->n / 200;
    const double low = sample->value[few], high = sample->value[sample->n - 1 - few];
    if (s->upper - s->lower <= 2.0 * (high - low) || !(high > low)) return;
    s->lower = low;
    s->upper = high;
}

/* Something to show where there is but one value. */
static void widen_scale(scale *s, bool about_zero)
{
    const double middle = 0.5 * (s->lower + s->upper);
    const double margin = middle != 0.0 ? 0.1 * fabs(middle) : 1.0;
    s->lower = middle == 0.0 && !about_zero ? 0.0 : middle - margin;
    s->upper = middle + margin;
}

void scale_from_sample(scale *s, scale_sample *sample, bool about_zero)
{
    choose_range(s, sample);
    if (!(s->upper - s->lower > 1e-9 * fmax(fabs(s->lower), fabs(s->upper)))) {
        widen_scale(s, about_zero);
        about_zero = false;
    }
    if (about_zero && s->lower < 0.0 && s->upper > 0.0) {
        s->upper = fmax(-s->lower, s->upper);
        s->lower = -s->upper;
    }
    const double step = round_below(0.05 * (s->upper - s->lower));
    s->lower = step * floor(s->lower / step + 1e-6);
    s->upper = step * ceil(s->upper / step - 1e-6);
    s->more_below = sample->met > 0 && sample->least < s->lower;
    s->more_above = sample->met > 0 && sample->most > s->upper;
}

static const char superscript[10][4] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};

static void append_label(char *text, const char *more)
{
    const size_t length = strlen(text);
    (void)snprintf(text + length, SCALE_TEXT - length, "%s", more);
}

static void append_power(char *text, int power)
{
    char digits[16];
    (void)snprintf(digits, sizeof digits, "%d", abs(power));
    append_label(text, power < 0 ? "10⁻" : "10");
    for (const char *d = digits; *d; d++) append_label(text, superscript[*d - '0']);
}

/* "kg/m3" as "kg/m³"; "1" as "". A digit after a letter is an exponent. */
static void append_unit(char *text, const char *unit)
{
    if (strcmp(unit, "1") == 0) return;
    for (char before = ' '; *unit; before = *unit++) {
        const bool exponent = *unit >= '0' && *unit <= '9' && before >= 'A';
        const char plain[2] = {*unit, '\0'};
        append_label(text, exponent ? superscript[*unit - '0'] : plain);
    }
}

/* Units that take SI prefixes: those whose first factor is one of these, to the first power. */
static bool takes_prefix(const char *unit)
{
    static const char *const known[] = {"Pa", "s", "m", "J", "N", "W", "Hz"};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        const size_t length = strlen(known[i]);
        if (strncmp(unit, known[i], length) == 0 && (unit[length] == '\0' || strchr("/ ", unit[length]))) return true;
    }
    return false;
}

/* The power of ten, a multiple of three, in which numbers up to `size` are shown. */
static int choose_power(double size, double from, double below)
{
    if (!(size > 0.0) || (size >= from && size < below)) return 0;
    return 3 * (int)floor(log10(1.05 * size) / 3.0); /* 1 of the larger rather than 999 of the smaller */
}

/* The factor of what is shown, and its unit. */
static double choose_unit(char text[SCALE_TEXT], double size, const char *unit)
{
    static const char *const prefix[] = {"n", "µ", "m", "", "k", "M", "G", "T"};
    const int si = choose_power(size, 0.1, 1000.0);
    text[0] = '\0';
    if (takes_prefix(unit) && si >= -9 && si <= 12) {
        append_label(text, prefix[si / 3 + 3]);
        append_unit(text, unit);
        return pow(10.0, si);
    }
    const int power = choose_power(size, 1e-2, 1e4);
    if (power != 0) append_power(text, power);
    if (power != 0 && strcmp(unit, "1") != 0) append_label(text, " ");
    append_unit(text, unit);
    return pow(10.0, power);
}

/* Typography: a minus is not a hyphen, and zero has no sign. */
static void print_number(char text[SCALE_TEXT], const char *format, int digits, double value)
{
    char plain[SCALE_TEXT];
    (void)snprintf(plain, sizeof plain, format, digits, value);
    const bool minus = plain[0] == '-';
    const bool zero = strspn(plain, "-0.") == strlen(plain);
    (void)snprintf(text, SCALE_TEXT, "%s%.80s", minus && !zero ? "−" : "", minus ? plain + 1 : plain);
}

void scale_number(char text[SCALE_TEXT], double value, const char *unit, int digits)
{
    char shown[SCALE_TEXT];
    const double factor = choose_unit(shown, fabs(value), unit);
    print_number(text, "%.*g", digits, value / factor);
    if (shown[0]) append_label(text, " ");
    append_label(text, shown);
}

/* A narrow range far from zero is shown as what is above a round number within or beside it. */
static void choose_offset(scale *s, const char *unit)
{
    const double size = fmax(fabs(s->lower), fabs(s->upper));
    const double span = s->upper - s->lower;
    char number[SCALE_TEXT];
    s->offset = 0.0;
    s->offset_text[0] = '\0';
    if (span > 1e-3 * size) return;
    const double grain = pow(10.0, ceil(log10(span)));
    s->offset = grain * ceil(0.5 * (s->lower + s->upper) / grain - 0.5);
    scale_number(number, fabs(s->offset), unit, 12);
    (void)snprintf(s->offset_text, sizeof s->offset_text, " %s %.80s", s->offset < 0.0 ? "+" : "−", number);
}

void scale_set_unit(scale *s, const char *unit)
{
    choose_offset(s, unit);
    s->factor = choose_unit(s->unit, fmax(fabs(s->lower - s->offset), fabs(s->upper - s->offset)), unit);
}

void scale_set_unit_for(scale *s, const char *unit, double size)
{
    s->offset = 0.0;
    s->offset_text[0] = '\0';
    s->factor = choose_unit(s->unit, size, unit);
}

void scale_make_ticks(const scale *s, int most, scale_ticks *out)
{
    const double low = (s->lower - s->offset) / s->factor, high = (s->upper - s->offset) / s->factor;
    double step = round_above((high - low) / most);
    while (floor(high / step + 1e-9) - ceil(low / step - 1e-9) + 1 > most) step = round_above(1.01 * step);
    const int decimals = (int)fmax(0.0, -floor(log10(step) + 1e-9));
    out->n = 0;
    const double first = ceil(low / step - 1e-9);
    for (int i = 0; i < most && first + i <= high / step + 1e-9; i++) {
        const double shown = (first + i) * step;
        out->value[i] = s->offset + s->factor * shown;
        print_number(out->label[i], "%.*f", decimals, shown);
        out->n = i + 1;
    }
}
