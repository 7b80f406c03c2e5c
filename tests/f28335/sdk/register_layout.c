/* SPDX-License-Identifier: MIT */
/* TI's headers against the table that the stand-ins are tested with: place of every register, place and width of every
 * field. Two host octets stand for a word. */
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "DSP28x_Project.h"

#define WORDS_MAX          0x100
#define COUNTED(r)         r /* the stand-in counts its accesses */
#define BEHIND_FLAGS(word) (word)

static int wrong;

static void expect(int right, const char *name)
{
    if (!right) {
        (void)fprintf(stderr, "%s: not where the stand-in has it\n", name);
        wrong++;
    }
}

static void expect_field(const Uint16 *got, int word, int lowest, int width, const char *name)
{
    const Uint64 mask = ((((Uint64)1) << width) - 1U) << lowest;
    Uint16       want[WORDS_MAX + 1];

    memset(want, 0, sizeof want);
    want[word]     = (Uint16)(mask & 0xFFFFU);
    want[word + 1] = (Uint16)(mask >> 16);
    expect(memcmp(got, want, 2U * WORDS_MAX) == 0, name);
}

#define REGISTER(type, member, word, bytes)                                                        \
    expect(offsetof(struct type, member) == 2U * (word) &&                                         \
               sizeof(((struct type *)0)->member) == (bytes),                                      \
           #type "." #member);
#define FIELD(type, field, word, lowest, width)                                                    \
    {                                                                                              \
        union {                                                                                    \
            struct type registers;                                                                 \
            Uint16      words[WORDS_MAX];                                                          \
        } at;                                                                                      \
        memset(&at, 0, sizeof at);                                                                 \
        --at.registers.field;                                                                      \
        expect_field(at.words, word, lowest, width, #type "." #field);                             \
    }

int main(void)
{
#include "layout_table.inc"
    return wrong == 0 ? 0 : 1;
}
