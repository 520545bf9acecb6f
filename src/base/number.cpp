// number.cpp: the C face of std::to_chars and std::from_chars, the standard library's shortest
// round-trip formatting and locale-free reading of doubles.
#include "base/text.h"

#include <charconv>
#include <system_error>

extern "C" size_t number_format(double value, char *out)
{
    if (value == 0.0) value = 0.0; // one spelling of zero: -0 prints as 0
    return static_cast<size_t>(std::to_chars(out, out + NUMBER_SIZE, value).ptr - out);
}

extern "C" bool number_read(const char *s, size_t n, double *value)
{
    if (n > 0 && s[0] == '+') s++, n--;
    if (n == 0) return false;
    const char first = s[0] == '-' && n > 1 ? s[1] : s[0];
    if (!((first >= '0' && first <= '9') || first == '.')) return false; // no inf, nan, sign twice
    double read = 0;
    const auto result = std::from_chars(s, s + n, read);
    if (result.ptr != s + n) return false;
    if (result.ec == std::errc::result_out_of_range) {
        // libstdc++ reports underflow and overflow alike and leaves the value: strtod tells them apart
        // by sign of the exponent; an overflow is an error, an underflow is zero.
        bool negative_exponent = false;
        for (size_t i = 0; i + 1 < n; i++)
            if ((s[i] == 'e' || s[i] == 'E') && s[i + 1] == '-') negative_exponent = true;
        if (!negative_exponent) return false;
        read = 0;
    } else if (result.ec != std::errc()) {
        return false;
    }
    *value = read;
    return true;
}
