/* SPDX-License-Identifier: MIT */
/**
 * @file fields_named.h
 * @brief Names of the members for a walk of fields.h, on hosts only.
 */
#ifndef FIELDS_NAMED_H
#define FIELDS_NAMED_H

struct fields;

typedef enum { FIELDS_U16, FIELDS_I16, FIELDS_U32, FIELDS_FLAG, FIELDS_FLOAT } fields_kind_t;

/** Receives the members of a walk in its order. A row's numbers have no name. */
typedef struct fields_listener {
    void *self;
    void (*begin)(void *self, const char *name); /**< of a structure or a row */
    void (*end)(void *self);
    void (*number)(void *self, const char *name, fields_kind_t kind, const void *x);
} fields_listener_t;

void fields_name(struct fields *f, const char *name);
void fields_begin(struct fields *f, const char *name);
void fields_end(struct fields *f);
/** Tells the listener of f a number, if it has one. */
void fields_tell(struct fields *f, fields_kind_t kind, const void *x);

#define FIELD(f, c, member)   (fields_name((f), #member), &(c)->member)
#define FIELDS_NAME(f, name)  fields_name((f), #name)
#define FIELDS_BEGIN(f, name) fields_begin((f), #name)
#define FIELDS_END(f)         fields_end(f)
#define FIELDS_PART(walk, f, c, member)                                                            \
    do {                                                                                           \
        fields_begin((f), #member);                                                                \
        (walk)((f), &(c)->member);                                                                 \
        fields_end(f);                                                                             \
    } while (false)
#define FIELDS_TELL(f, kind, x) fields_tell((f), (kind), (x))

#endif /* FIELDS_NAMED_H */
