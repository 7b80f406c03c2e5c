/* SPDX-License-Identifier: MIT */
/* clang: uninitialized */
/* cppcheck: uninitvar */
int uninitialised(void);
int uninitialised(void)
{
    int count;
    return count + 1;
}
