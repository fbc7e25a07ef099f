//! What the program promises, and which faults and bad files it handles, each with the tests that hold it. Numbers are those of
//! the catalogue that the tests were written from: P promises, F faults, the rest bad files.
//!
//! | promise, fault or file | tests |
//! | --- | --- |
//! | P1 a file on disk is the whole old one or the whole new one | `a_save_that_is_killed_leaves_the_old_file_or_the_new_one`, `several_are_written_or_none` |
//! | P2 a crash loses no more than the command that was being written | `a_process_that_is_killed_loses_at_most_the_command_it_was_writing`, `what_is_found_after_a_kill_is_the_work_up_to_a_whole_command` |
//! | P3 no file crashes the program, holds it up or takes more memory than it may | `damaged_files_are_taken_or_refused_in_words_and_in_time`, `cloth_too_fine_for_its_size_is_not_cut`, `what_has_no_end_is_not_read` |
//! | P4 the same work gives the same bits on any number of threads | `the_report_is_printed_and_the_same_on_any_number_of_threads`, `samples_are_the_same_on_any_number_of_threads`, `on_the_mannequin` |
//! | P5 without a window nothing asks, opens or needs one | `without_a_display_it_says_how_to_do_without`, `whatever_is_round_it_the_same_comes_of_it` |
//! | P6 only files that were named, or lie beside them, are read | `only_files_in_its_folder_are_opened`, `links_in_a_circle_are_refused` |
//! | F01, F02 killed while saving | `a_save_that_is_killed_leaves_the_old_file_or_the_new_one` |
//! | F03, F04 a disk that is full | `a_disk_that_is_full_leaves_the_file_and_the_document`, `a_disk_that_is_really_full_keeps_what_was_on_it` |
//! | F05, F08 a folder that is protected or gone | `a_save_that_cannot_be_asks_where_else`, `a_file_in_a_folder_that_is_gone_is_not_taken_for_saved` |
//! | F06 a protected file | `a_file_that_is_write_protected_is_replaced_only_when_that_is_meant`, `a_protected_file_is_replaced_only_when_that_is_meant` |
//! | F07, F09 links; the new file is made beside the old | `a_link_stays_and_what_it_leads_to_is_written` |
//! | F10, F11 writes that fail, are short or interrupted | `what_did_not_reach_the_disk_is_not_called_saved`, `writes_that_are_short_or_interrupted_are_gone_on_with` |
//! | F12, F13 a file that somebody else changed | `a_file_that_somebody_else_changed_is_not_written_over` |
//! | F14 what could not be read back is not written | `a_project_that_could_not_be_read_back_is_not_written` |
//! | F15 a clock that goes back | `which_copy_is_newest_is_told_by_its_number_whatever_the_clock_said` |
//! | F16, F17 preferences cut or foreign | `preferences_cut_anywhere_are_set_aside`, `what_was_written_is_read_and_what_is_broken_is_not` |
//! | F18 no home | `whatever_is_round_it_the_same_comes_of_it` |
//! | F19 names of any kind | `files_of_any_name_are_read_and_written`, `names_that_are_no_unicode_are_read_and_written` |
//! | F20 killed at any command | `what_is_found_after_a_kill_is_the_work_up_to_a_whole_command` |
//! | F21 a journal cut or damaged anywhere | `a_journal_cut_anywhere_gives_what_came_before`, `a_damaged_copy_gives_way_to_the_one_before_and_both_journals` |
//! | F22 a crash while work is restored | `a_crash_while_work_is_restored_leaves_it_for_the_next_time` |
//! | F23 another instance | `a_live_session_is_left_alone_and_one_that_ended_well_leaves_nothing` |
//! | F24 three crashes at the start | `after_three_starts_that_failed_the_next_is_plain_until_one_succeeds` |
//! | F25, F29 a panic or numbers that are none, in every stage | `every_stage_survives_numbers_that_are_none_and_panics`, `a_panic_in_a_step_is_taken_back_and_told`, `a_number_that_is_none_is_taken_back_and_told` |
//! | F26 a panic in one of many | `the_greatest_exit_code_counts_and_each_says_why` |
//! | F27 deep nesting | `damaged_files_are_taken_or_refused_in_words_and_in_time` |
//! | F28 no lock is expected to be whole | `no_lock_is_expected_to_be_whole` |
//! | F30, F31 cancelled at any moment | `esc_cancels_the_whole_run`, `a_run_can_be_cancelled_and_changed_while_it_lasts`, `esc_gives_redo_back` |
//! | F32, F37 no graphics, or graphics that do not answer | `a_project_is_dressed_without_an_adapter`, `an_adapter_that_does_not_answer_is_not_waited_for_without_end` |
//! | F33, F34 graphics that are lost | `a_lost_graphics_device_takes_nothing_with_it` |
//! | F35, F36 windows and pictures of any size | `a_window_of_any_size_and_shape_is_drawn`, `a_picture_that_is_too_large_is_refused_in_words` |
//! | F38 signals at any moment of every subcommand | `dressing_stops_at_any_moment_and_leaves_nothing_half_done`, `every_subcommand_is_stopped`, `a_signal_stops_it_with_its_code_and_no_files` |
//! | no frame of the window keeps anybody waiting, whatever is chosen | `every_command_answers_on_an_empty_table`, `every_command_answers_on_a_pattern_with_marks`, `every_command_answers_on_a_dressed_body` |
//! | F39 a reader that goes away | `a_reader_that_goes_away_is_no_failure` |
//! | F40 threads, stacks, languages, folders, ten at once | `whatever_is_round_it_the_same_comes_of_it`, `ten_at_once_in_one_folder_do_not_disturb_one_another`, `a_folder_that_cannot_be_written_to_is_no_hindrance_to_work_elsewhere` |
//! | bad OBJ (1 to 20) | `faults_are_named_with_their_line`, `every_truncation_ends_without_panic` |
//! | bad glTF (21 to 35) | `faulty_scenes_are_refused_in_words`, `only_files_in_its_folder_are_opened` |
//! | bad SVG (36 to 43) | `faults_of_paths_are_told`, `faulty_patterns_are_refused` |
//! | bad DXF (44 to 51) | `blocks_without_end_are_refused`, `faulty_patterns_are_refused` |
//! | bad GarmentCode, projects, recordings (52 to 58) | `faults_are_named_with_their_place`, `damaged_zips_never_panic`, `damaged_recordings_name_the_line` |
//! | random work of every command | `on_a_ball`, `on_a_cylinder`, `on_a_limb`, `on_a_spindle_with_placed_pieces`, `on_the_mannequin` |
//! | scales, places, counts | `dolls_and_statues_are_dressed`, `the_finest_and_the_coarsest_triangles_are_wrapped`, `a_kilometre_away_cloth_lies_as_it_does_here`, `cloth_of_one_two_and_three_triangles_is_dressed`, `a_body_of_half_a_million_triangles_is_dressed` |
//! | quiet | `without_a_display_or_a_folder_for_one_nothing_is_complained_of`, `what_is_asked_for_is_all_that_is_on_standard_output` |
//!
//! `tests/tidy` checks that each of these tests exists.
