/* The two notations of CCSDS messages as one list of items. */
#include "orbit/ccsds.h"
#include "scenario_text.h"

#include "base/text.h"

static const char KVN[] = "CCSDS_OEM_VERS = 2.0\n"
                          "COMMENT a = b\n"
                          "META_START\n"
                          "OBJECT_NAME = CUBE [1]\n"
                          "META_STOP\n"
                          "\n"
                          "2025-07-24T00:00:00 1 2 3\n"
                          "COVARIANCE_START\n"
                          "COVARIANCE_STOP\n";

static const char XML[] = "<?xml version=\"1.0\"?>\n"
                          "<oem id=\"CCSDS_OEM_VERS\" version=\"2.0\">\n"
                          "  <body><!-- a note --><COMMENT>a = b</COMMENT>\n"
                          "    <OBJECT_NAME> CUBE &amp; <![CDATA[ball]]></OBJECT_NAME>\n"
                          "    <X units=\"km\">1</X><EMPTY/>\n"
                          "  </body>\n"
                          "</oem>\n";

/* All items as "kind keyword=value|unit@line:column;". */
static char *list_items(const ccsds_file *file)
{
    text out = {0};
    for (size_t k = 0; k < file->count; k++) {
        const ccsds_item *i = &file->items[k];
        text_printf(&out, "%c %s=%s|%s@%d:%d;", "vbel"[i->kind], i -> keyword, i -> value,
                    i -> unit, i -> line, i -> column);
    }
    return out.data ? out.data : string_copy("", 0);
}

static glint_status scan(const char *content, ccsds_file *file, glint_errors *errors)
{
    const size_t n = strlen(content);
    return ccsds_scan("in.txt", string_copy(content, n), n, file, errors);
}

static void assert_items(const char *content, const char *want)
{
    ccsds_file file;
    glint_errors *errors = glint_errors_new();
    ck_assert_msg(scan(content, &file, errors) == GLINT_OK, "%s", list_errors(errors));
    ck_assert_uint_eq(glint_errors_count(errors), 0);
    char *got = list_items(&file);
    ck_assert_str_eq(got, want);
    free(got);
    ccsds_free(&file);
    glint_errors_free(errors);
}

START_TEST(test_ccsds_scan_reads_kvn)
{
    assert_items(KVN, "v CCSDS_OEM_VERS=2.0|@1:18;b METADATA=|@3:1;v OBJECT_NAME=CUBE [1]|@4:15;"
                      "e METADATA=|@5:1;l =2025-07-24T00:00:00 1 2 3|@7:1;b COVARIANCE=|@8:1;"
                      "e COVARIANCE=|@9:1;");
}
END_TEST

START_TEST(test_ccsds_scan_takes_line_ends_tabs_case_and_mark)
{
    assert_items("\xEF\xBB\xBF\tmeta_start\r\n Object_Name\t=\tCube \r\nmeta_stop\r\n",
                 "b METADATA=|@1:2;v OBJECT_NAME=Cube|@2:16;e METADATA=|@3:1;");
}
END_TEST

START_TEST(test_ccsds_scan_reads_xml)
{
    assert_items(XML, "v CCSDS_OEM_VERS=2.0|@2:1;b OEM=|@2:1;b BODY=|@3:3;"
                      "v OBJECT_NAME=CUBE & ball|@4:5;v X=1|km@5:5;v EMPTY=|@5:24;"
                      "e BODY=|@6:3;e OEM=|@7:1;");
}
END_TEST

START_TEST(test_ccsds_scan_takes_prefixes_of_namespaces_off)
{
    assert_items("<ndm:oem xmlns:ndm='urn:x' version='3.0'><ndm:X>1</ndm:X></ndm:oem>",
                 "v CCSDS_OEM_VERS=3.0|@1:1;b OEM=|@1:1;v X=1|@1:42;e OEM=|@1:58;");
}
END_TEST

START_TEST(test_ccsds_scan_leaves_line_without_end_out)
{
    ccsds_file file;
    glint_errors *errors = glint_errors_new();
    ck_assert_int_eq(scan("A = 1\nB = 2", &file, errors), GLINT_OK);
    ck_assert_uint_eq(file.count, 1);
    ck_assert_uint_eq(glint_errors_count(errors), 1);
    ck_assert_int_eq(glint_errors_get(errors, 0)->severity, GLINT_WARNING);
    ck_assert_int_eq(glint_errors_get(errors, 0)->line, 2);
    ccsds_free(&file);
    glint_errors_clear(errors);
    ck_assert_int_eq(scan("A = 1\nDATA_STOP", &file, errors), GLINT_OK); /* no number to cut */
    ck_assert_uint_eq(file.count, 2);
    ck_assert_uint_eq(glint_errors_count(errors), 0);
    ccsds_free(&file);
    glint_errors_free(errors);
}
END_TEST

START_TEST(test_ccsds_scan_refuses_cut_xml_everywhere)
{
    for (size_t n = 1; n + 1 < strlen(XML); n++) { /* the last byte is a line end */
        char *cut = string_copy(XML, n);
        ccsds_file file;
        ck_assert_msg(ccsds_scan("in.xml", cut, n, &file, NULL) == GLINT_INPUT, "%zu bytes", n);
        ck_assert_ptr_null(file.items);
    }
}
END_TEST

START_TEST(test_ccsds_scan_refuses_declarations_depth_and_zero_bytes)
{
    static const char *const wrong[][2] = {
        {"<!DOCTYPE oem [<!ENTITY a \"b\">]><oem>&a;</oem>\n", "document type declaration"},
        {"<oem><x></oem>\n", "well-formed"},
        {"<oem>\xff</oem>\n", "well-formed"},
    };
    for (size_t k = 0; k < COUNT_OF(wrong); k++) {
        ccsds_file file;
        glint_errors *errors = glint_errors_new();
        ck_assert_int_eq(scan(wrong[k][0], &file, errors), GLINT_INPUT);
        ck_assert(has_error(errors, "in.txt", 0, 0, wrong[k][1], NULL));
        glint_errors_free(errors);
    }
    text deep = {0};
    for (int k = 0; k < 40; k++)
        text_add(&deep, "<a>");
    ccsds_file file;
    ck_assert_int_eq(ccsds_scan("in.xml", deep.data, deep.length, &file, NULL), GLINT_INPUT);
    char *zero = string_copy("A = 1\0\n", 7);
    ck_assert_int_eq(ccsds_scan("in.txt", zero, 7, &file, NULL), GLINT_INPUT);
}
END_TEST

START_TEST(test_ccsds_number_holds_units)
{
    static const struct {
        const char *value, *attribute, *unit;
        bool good;
    } cases[] = {
        {"15.0", "", "rev/day", true},
        {"15.0 [rev/day]", "", "rev/day", true},
        {"15.0[REV/DAY]", "", "rev/day", true},
        {"15.0 [km]", "", "rev/day", false},
        {"15.0", "km", "rev/day", false},
        {"15.0", "rev/day", "rev/day", true},
        {"15.0 [x]", "", NULL, true},
        {"15.0]", "", "km", false},
        {"[km]", "", "km", false},
        {"", "", "km", false},
        {"nan", "", "km", false},
        {"1e999", "", "km", false},
        {"15.0 7", "", "km", false},
    };
    const ccsds_file file = {.path = "in.txt"};
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        const ccsds_item item = {CCSDS_VALUE, "N", cases[k].value, cases[k].attribute, 1, 1};
        double value;
        const glint_status status = ccsds_number(&file, &item, cases[k].unit, &value, NULL);
        ck_assert_msg((status == GLINT_OK) == cases[k].good, "'%s'", cases[k].value);
        if (cases[k].good) assert_near(value, 15.0, 0.0);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("ccsds");
    TCase *all = tcase_create("all");
    tcase_add_test(all, test_ccsds_scan_reads_kvn);
    tcase_add_test(all, test_ccsds_scan_takes_line_ends_tabs_case_and_mark);
    tcase_add_test(all, test_ccsds_scan_reads_xml);
    tcase_add_test(all, test_ccsds_scan_takes_prefixes_of_namespaces_off);
    tcase_add_test(all, test_ccsds_scan_leaves_line_without_end_out);
    tcase_add_test(all, test_ccsds_scan_refuses_cut_xml_everywhere);
    tcase_add_test(all, test_ccsds_scan_refuses_declarations_depth_and_zero_bytes);
    tcase_add_test(all, test_ccsds_number_holds_units);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
