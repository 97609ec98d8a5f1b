%   swipl tests/run.pl: all tests; the last line says "N passed, N failed".
:- use_module(library(plunit)).
:- use_module(library(lists)).
:- set_prolog_flag(verbose, silent).
:- initialization(main, main).
:- prolog_load_context(directory, Here),
   atom_concat(Here, '/*.plt', Pattern),
   expand_file_name(Pattern, Files),
   forall(member(File, Files), use_module(File)).

main :-
    ( run_tests -> Ran = true ; Ran = false ),
    aggregate_all(count, plunit:passed(_, _, _, _, _), Passed),
    aggregate_all(count, plunit:failed(_, _, _, _), Failed0),
    ( Ran == false, Failed0 =:= 0 -> Failed = 1 ; Failed = Failed0 ),
    format("~d passed, ~d failed~n", [Passed, Failed]),
    ( Failed =:= 0, Passed > 0 -> halt(0) ; halt(1) ).
