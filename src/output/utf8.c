#include "output/utf8.h"

size_t utf8_read(const char *string, size_t n, unsigned *out)
{
    static const unsigned LEAST[5] = {0, 0, 0x80, 0x800,
                                      0x10000}; /* shorter forms are not allowed */
    const unsigned char *s = (const unsigned char *)string;
    const size_t length = s[0] < 0x80             ? 1
                          : (s[0] & 0xe0) == 0xc0 ? 2
                          : (s[0] & 0xf0) == 0xe0 ? 3
                          : (s[0] & 0xf8) == 0xf0 ? 4
                                                  : 0;
    if (length == 0 || length > n) return 0;
    unsigned c = length == 1 ? s[0] : s[0] & (0x7fu >> length);
    for (size_t i = 1; i < length; i++) {
        if ((s[i] & 0xc0) != 0x80) return 0;
        c = c << 6 | (s[i] & 0x3fu);
    }
    if (c < LEAST[length] || c > 0x10ffff || (c >= 0xd800 && c < 0xe000)) return 0;
    *out = c;
    return length;
}
