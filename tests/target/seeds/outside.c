/* SPDX-License-Identifier: MIT */
/* cppcheck: arrayIndexOutOfBounds */
int outside(void);
int outside(void)
{
    int codes[4] = {0, 0, 0, 0};
    for (int i = 0; i <= 4; i++) {
        codes[i] = i;
    }
    return codes[0];
}
