/* A small, strict reader of XML for the tests: elements, attributes, text; anything not well-formed fails the test. */
#ifndef TESTS_UNIT_TEST_IO_XML_H
#define TESTS_UNIT_TEST_IO_XML_H

#include "check.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { XML_DEPTH = 16, XML_ATTRIBUTES = 8, XML_TEXT = 512 };

typedef struct xml_attribute {
    char name[64], value[XML_TEXT];
} xml_attribute;

typedef struct xml_element {
    char name[64];
    xml_attribute attribute[XML_ATTRIBUTES];
    int n_attributes;
    char text[XML_TEXT]; /* between its tags, children apart, outer blanks left out */
} xml_element;

/* Called at the end of each element; open[depth] is the element, open[0..depth-1] are those around it. */
typedef void xml_visitor(void *user, const xml_element *open, int depth);

static inline bool xml_blank(char c)
{
    return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}

static inline void xml_skip_blanks(const char **at)
{
    while (xml_blank(**at)) (*at)++;
}

static inline void xml_name(const char **at, char name[64])
{
    const size_t n = strcspn(*at, " \n\t\r/>=<\"'&");
    assert_true(n > 0 && n < 64);
    memcpy(name, *at, n);
    name[n] = '\0';
    *at += n;
}

/* One character of content; entities are resolved, a bare '<' or '&' is not allowed. */
static inline char xml_character(const char **at)
{
    static const char *const entity[] = {"&lt;", "&gt;", "&amp;", "&quot;", "&apos;"};
    static const char plain[] = "<>&\"'";
    for (size_t i = 0; i < 5; i++) {
        if (strncmp(*at, entity[i], strlen(entity[i])) != 0) continue;
        *at += strlen(entity[i]);
        return plain[i];
    }
    assert_true(**at != '<' && **at != '&' && **at != '\0');
    return *(*at)++;
}

static inline void xml_attributes(const char **at, xml_element *e)
{
    e->n_attributes = 0;
    for (;;) {
        const bool separated = xml_blank(**at);
        xml_skip_blanks(at);
        if (**at == '>' || **at == '/' || **at == '?') return;
        assert_true(separated && e->n_attributes < XML_ATTRIBUTES);
        xml_attribute *a = &e->attribute[e->n_attributes++];
        xml_name(at, a->name);
        for (int i = 0; i < e->n_attributes - 1; i++) assert_string_not_equal(e->attribute[i].name, a->name);
        assert_int_equal(*(*at)++, '=');
        assert_int_equal(*(*at)++, '"');
        size_t n = 0;
        while (**at != '"') {
            assert_true(n < XML_TEXT - 1);
            a->value[n++] = xml_character(at);
        }
        a->value[n] = '\0';
        (*at)++;
    }
}

/* The value of an attribute; the test fails if it is not there. */
static inline const char *xml_get(const xml_element *e, const char *name)
{
    for (int i = 0; i < e->n_attributes; i++) {
        if (strcmp(e->attribute[i].name, name) == 0) return e->attribute[i].value;
    }
    print_error("<%s> has no %s\n", e->name, name);
    assert_true(false);
    return "";
}

static inline void xml_content(const char **at, xml_element *e)
{
    while (**at != '<') {
        const char c = xml_character(at);
        const size_t n = strlen(e->text);
        if (n == 0 && xml_blank(c)) continue;
        assert_true(n < XML_TEXT - 1);
        e->text[n] = c;
        e->text[n + 1] = '\0';
    }
}

/* Reads one document from its first byte to its last. */
static inline void xml_read(const char *text, xml_visitor *visit, void *user)
{
    static xml_element open[XML_DEPTH];
    int depth = -1;
    const char *at = text;
    assert_int_equal(strncmp(at, "<?xml ", 6), 0);
    while (strncmp(at, "?>", 2) != 0) assert_true(*at++ != '\0');
    at += 2;
    do {
        if (depth < 0)
            xml_skip_blanks(&at);
        else
            xml_content(&at, &open[depth]);
        assert_int_equal(*at++, '<');
        if (*at == '/') {
            char name[64];
            at++;
            xml_name(&at, name);
            assert_string_equal(name, open[depth].name);
            assert_int_equal(*at++, '>');
            visit(user, open, depth--);
            continue;
        }
        assert_true(depth < XML_DEPTH - 1);
        xml_element *e = &open[++depth];
        *e = (xml_element){0};
        xml_name(&at, e->name);
        xml_attributes(&at, e);
        if (*at == '/') {
            at++;
            visit(user, open, depth--);
        }
        assert_int_equal(*at++, '>');
    } while (depth >= 0);
    xml_skip_blanks(&at);
    assert_int_equal(*at, '\0');
}

#endif
