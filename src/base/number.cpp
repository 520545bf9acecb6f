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

namespace
{

// Whether a decimal number that is out of a double's range is too large, not too small: by the
// power of ten of its first digit that is not 0. The standard library reports both alike.
bool is_too_large(const char *s, size_t n)
{
    long long before_point = 0, exponent = 0; // digits from the first that is not 0 up to the point
    bool seen_point = false, seen_digit = false;
    for (size_t i = 0; i < n; i++) {
        if (s[i] == 'e' || s[i] == 'E') {
            const bool plus = i + 1 < n && s[i + 1] == '+';
            const auto read = std::from_chars(s + i + 1 + plus, s + n, exponent);
            if (read.ec == std::errc::result_out_of_range) return s[i + 1] != '-';
            break;
        }
        if (s[i] == '.') {
            seen_point = true;
            continue;
        }
        if (s[i] == '-') continue;
        seen_digit = seen_digit || s[i] != '0';
        if (!seen_point && seen_digit) before_point++;
        if (seen_point && !seen_digit) before_point--;
    }
    return before_point + exponent > 0;
}

} // namespace

extern "C" bool number_read(const char *s, size_t n, double *value)
{
    if (n > 1 && s[0] == '+' && s[1] != '-') s++, n--;
    if (n == 0) return false;
    const char first = s[0] == '-' && n > 1 ? s[1] : s[0];
    if (!((first >= '0' && first <= '9') || first == '.')) return false; // no inf, nan, sign twice
    double read = 0;
    const auto result = std::from_chars(s, s + n, read);
    if (result.ptr != s + n) return false;
    if (result.ec == std::errc::result_out_of_range) {
        if (is_too_large(s, n)) return false;
        read = 0;
    } else if (result.ec != std::errc()) {
        return false;
    }
    *value = read;
    return true;
}
