"""Which tests only the whole suite runs, and which one interpreter is enough for.

An entry is a folder, a file or a test, below ``tests``::

    pytest -m "not slow" -n 2    while you work: minutes, and something of every part
    pytest                       before a change lands, on one interpreter
    pytest -m "not once"         on the others
"""

from __future__ import annotations

__all__ = ["ONCE", "SLOW", "is_listed"]

SLOW = (
    # other programs, several hosts, real compilers and checkers
    "hosts",
    "interop",
    "master/test_same_as_rosmaster.py",
    "master/test_same_notifications.py",
    "typing/test_checkers.py",
    # each test is run hundreds of times, or tests a whole program
    "cancellation/test_cancellation.py",
    "cancellation/test_life.py",
    "test_benchmarks.py",
    "test_examples.py",
    "test_fuzz_corpus.py",
    "test_fuzz_live.py",
    "test_script_end.py",
    "test_soak.py",
    # pytest in pytest, Python in Python
    "cli/test_master.py",
    "contrib/test_threads.py::test_a_process_that_was_forked_is_told_that_it_has_no_node",
    "contrib/test_threads.py::test_a_program_that_forgets_to_close_it_does_so_on_its_way_out",
    "faults/test_closing.py::test_a_node_that_was_never_closed_is_warned_of_and_freed",
    "faults/test_closing.py::test_a_node_whose_loop_was_closed_is_warned_of_and_freed",
    "test_docs.py::test_programs_run",
    "test_docs.py::test_tests_pass",
    "test_embedding.py::test_no_warning_in_debug_mode_with_warnings_as_errors",
    "test_script.py::test_a_file_that_cannot_be_written_is_no_reason_to_end",
    "test_script.py::test_a_signal_while_the_node_waits_for_its_master",
    "test_script.py::test_what_it_logs_is_in_the_file_that_roslaunch_names",
    "testing/test_pytest_plugin.py",
    "topics/test_local_transports.py::test_another_process_of_the_host",
    # many messages, connections or bytes, or memory and calls that are counted
    "idl/test_bundle.py::test_all_can_be_sent",
    "idl/test_bundle.py::test_debian_has_what_its_table_says",
    "idl/test_hostile.py::test_a_length_that_is_not_there_costs_no_memory",
    "idl/test_hostile.py::test_messages_without_octets_in_rows_are_bounded",
    "idl/test_hostile.py::test_messages_without_octets_inside_one_another_are_bounded",
    "idl/test_hostile.py::test_the_text_of_a_definition_is_not_kept_once_for_each_type",
    "idl/test_hostile.py::test_twice_the_types_take_twice_the_time",
    "idl/test_hostile.py::test_types_of_many_fields_can_be_used",
    "idl/test_hostile.py::test_what_a_decoder_remembers_is_bounded",
    "idl/test_hostile.py::test_what_a_decoder_remembers_of_mistakes_is_bounded",
    "test_embedding.py::test_twenty_two_nodes_start_stop_and_start_again_and_leave_nothing",
    "testing/test_flaky_proxy.py::test_corrupt_every_byte",
    "testing/test_flaky_proxy.py::test_corrupt_some_bytes",
    "topics/test_local_transports.py::test_many_subscribers",
    "wire/test_xmlrpc_limits.py::test_the_number_of_values_without_another_word",
    # generated definitions, each of which is compiled
    "idl/test_codec_properties.py",
    "idl/test_convert.py::test_any_message_survives_in_json_form",
    "idl/test_convert.py::test_any_message_survives_yaml_as_it_is",
    "idl/test_layouts.py::test_damaged_octets",
    "master/test_parameters.py::test_what_was_read_does_not_change",
)

ONCE = (
    "cancellation",
    "hosts",
    "interop",
    "mapping/test_rows.py",
    "master/test_same_as_rosmaster.py",
    "master/test_same_notifications.py",
    "test_benchmarks.py",
    "test_docs.py",
    "test_examples.py",
    "test_fuzz_corpus.py",
    "test_fuzz_live.py",
    "test_soak.py",
    "typing/test_checkers.py",
)


def is_listed(entries: tuple[str, ...], file: str, test: str) -> bool:
    """Whether the entries have that test, or its file, or a folder that the file is in."""
    return any(
        entry in (file, f"{file}::{test}") or file.startswith(f"{entry}/") for entry in entries
    )
