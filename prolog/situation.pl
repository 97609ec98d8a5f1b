/*  What is true after which actions: the situation calculus of [Rhino1999] 4.3.

    A situation is

        now(State)        the robot's own: actions take time there, see golog.pl
        imagined(State)   of a plan: actions are done at once there
        do(Action, S)     what Action makes of the situation S

    A State holds all fluents that are true, in an assoc of Name/Arity to the sorted list of their instances. What holds
    in do(A, S) is asked by regression: of A's effects and of S. progress/4 rolls a state forward instead, so that asking
    costs the same after ten thousand actions as after one. Both say the same (tests/situation.plt).

    A domain is a module with these predicates, all of them optional; conditions are those of holds/3.

        fluent(F)                    F may be true or false; its arguments are variables
        functional(F)                the same, and its last argument, the value, is unique
        derived(F, Condition)        F is short for Condition
        initially(F)                 F is true in the beginning
        action(A)                    an action that programs may take
        exogenous(A)                 an event that comes from outside
        poss(A, Condition)           A is possible where the condition holds
        causes_true(A, F, Condition)    the effects of actions and events; a value that changes needs no causes_false
        causes_false(A, F, Condition)
        duration(A, Seconds, Condition)   what an action is expected to take
        proc(Head, Program)          a procedure, see golog.pl
        expects(Call, Goal)          a call or fluent without variables is a fault where the goal fails

    From causes_true (gamma+) and causes_false (gamma-) follows the successor-state axiom of each fluent:
    F(do(a, s)) holds if gamma+ holds in s, or if F(s) and not gamma- .
*/
:- module(situation, [holds/3, possible/3, initial_state/2, progress/4, put_fluent/3, state_fluents/2,
                      fluents_state/2, base_state/2, fresh/4, complete_domain/1, domain_predicate/1]).
:- use_module(library(assoc)).
:- use_module(library(apply)).
:- use_module(library(lists)).
:- use_module(library(ordsets)).
:- use_module(library(error)).

domain_predicate(fluent/1).
domain_predicate(functional/1).
domain_predicate(derived/2).
domain_predicate(initially/1).
domain_predicate(action/1).
domain_predicate(exogenous/1).
domain_predicate(poss/2).
domain_predicate(causes_true/3).
domain_predicate(causes_false/3).
domain_predicate(duration/3).
domain_predicate(proc/2).
domain_predicate(expects/2).

%!  complete_domain(+Domain) is det.
%   What the domain does not define is empty.
complete_domain(D) :-
    forall(( domain_predicate(Name/Arity), \+ current_predicate(D:Name/Arity) ), dynamic(D:Name/Arity)).

%!  holds(+Condition, +Situation, +Domain) is nondet.
%   Binds the variables of the condition.
%
%       true, (A, B), (A ; B), \+ A
%       some(X, C)          C holds for some X, which stays unbound
%       all(X, C, C2)       C2 holds for all X for which C holds
%       set(X, C, Xs)       Xs is the sorted list of all X for which C holds
%       F                   a fluent, a derived one, or
%       Goal                a predicate of the domain or of Prolog, such as X < 0.2
holds(C, _, _) :- var(C), !, instantiation_error(C).
holds(true, _, _) :- !.
holds((A, B), S, D) :- !, holds(A, S, D), holds(B, S, D).
holds((A ; B), S, D) :- !, ( holds(A, S, D) ; holds(B, S, D) ).
holds(\+ C, S, D) :- !, \+ holds(C, S, D).
holds(some(X, C), S, D) :- !, fresh(X, C, _, C1), \+ \+ holds(C1, S, D).
holds(all(X, C, C2), S, D) :- !,
    fresh(X, C-C2, _, Given-Wanted),
    \+ ( holds(Given, S, D), \+ holds(Wanted, S, D) ).
holds(set(X, C, Xs), S, D) :- !,
    fresh(X, C, X1, C1),
    findall(X1, holds(C1, S, D), List),
    sort(List, Xs).
holds(F, S, D) :- is_fluent(F, D), !, fluent_holds(F, S, D).
holds(F, S, D) :- \+ \+ D:derived(F, _), !, D:derived(F, C), holds(C, S, D).
holds(Goal, _, D) :- call(D:Goal).

is_fluent(under_way(_), _) :- !.
is_fluent(time(_), _) :- !.
is_fluent(news(_), _) :- !.
is_fluent(F, D) :- \+ \+ D:fluent(F), !.
is_fluent(F, D) :- is_functional(F, D).

is_functional(time(_), _) :- !.
is_functional(news(_), _) :- !.
is_functional(F, D) :- \+ \+ D:functional(F).

% Regression. Instances that were true and are caused again are found once.
fluent_holds(F, do(A, S), D) :- !,
    (   ground(F)
    ->  ( caused(A, F, S, D) -> true ; fluent_holds(F, S, D), \+ ended(A, F, S, D) )
    ;   findall(F, ( caused(A, F, S, D) ; fluent_holds(F, S, D), \+ caused(A, F, S, D), \+ ended(A, F, S, D) ), Fs),
        sort(Fs, Instances),
        member(F, Instances)
    ).
fluent_holds(F, S, _) :-
    base_state(S, State),
    instances(F, State, Instances),
    ( ground(F) -> memberchk(F, Instances) ; member(F, Instances) ).

caused(begin(A), under_way(A), _, _).
caused(A, F, S, D) :- D:causes_true(A, F, C), holds(C, S, D).

% The ground fluent F ends with A unless A causes it, too.
ended(ended(A), under_way(A), _, _).
ended(A, F, S, D) :- D:causes_false(A, F, C), holds(C, S, D).
ended(A, F, S, D) :- is_functional(F, D), other_value(F, Other), caused(A, Other, S, D).

other_value(F, Other) :-
    F =.. List,
    append(Front, [_], List), !,
    append(Front, [_], OtherList),
    Other =.. OtherList.

%!  possible(?Action, +Situation, +Domain) is nondet.
possible(A, S, D) :-
    (   ground(A)
    ->  once(( D:poss(A, C), holds(C, S, D) ))
    ;   D:poss(A, C), holds(C, S, D)
    ).

%!  initial_state(+Domain, -State) is det.
initial_state(D, State) :-
    findall(F, D:initially(F), Fs),
    fluents_state([time(0.0), news(0) | Fs], State).

%!  progress(+Action, +State, +Domain, -NewState) is det.
%   The state after the action, by the successor-state axioms. Costs as much as the action has effects.
progress(A, State, D, NewState) :-
    S = imagined(State),
    findall(F, caused(A, F, S, D), Caused),
    must_be(ground, A-Caused),
    findall(F, ended_instance(A, F, S, D), Ended),
    foldl(remove_fluent, Ended, State, Remaining),
    foldl(add_fluent(D), Caused, Remaining, NewState).

ended_instance(ended(A), under_way(A), _, _).
ended_instance(A, F, S, D) :- D:causes_false(A, F, C), fluent_holds(F, S, D), holds(C, S, D).

add_fluent(D, F, State, NewState) :-
    ( is_functional(F, D) -> put_fluent(F, State, NewState) ; insert_fluent(F, State, NewState) ).

insert_fluent(F, State, NewState) :-
    instances(F, State, Old),
    ord_add_element(Old, F, New),
    put_instances(F, State, New, NewState).

remove_fluent(F, State, NewState) :-
    instances(F, State, Old),
    ord_del_element(Old, F, New),
    put_instances(F, State, New, NewState).

%!  put_fluent(+F, +State, -NewState) is det.
%   Sets the value of a functional fluent.
put_fluent(F, State, NewState) :-
    other_value(F, Other),
    instances(F, State, Old),
    exclude_matching(Old, Other, Kept),
    ord_add_element(Kept, F, New),
    put_instances(F, State, New, NewState).

exclude_matching([], _, []).
exclude_matching([F | Fs], Pattern, Kept) :-
    ( F \= Pattern -> Kept = [F | Rest] ; Kept = Rest ),
    exclude_matching(Fs, Pattern, Rest).

instances(F, State, Instances) :-
    functor(F, Name, Arity),
    ( get_assoc(Name/Arity, State, Found) -> Instances = Found ; Instances = [] ).

put_instances(F, State, Instances, NewState) :-
    functor(F, Name, Arity),
    put_assoc(Name/Arity, State, Instances, NewState).

%!  base_state(+Situation, -State) is det.
base_state(now(State), State).
base_state(imagined(State), State).

%!  state_fluents(+State, -Fluents) is det.
%   All that is true, sorted by kind; fluents_state/2 is its inverse.
state_fluents(State, Fluents) :- assoc_to_values(State, Lists), append(Lists, Fluents).

fluents_state(Fluents, State) :-
    must_be(ground, Fluents),
    empty_assoc(Empty),
    foldl(insert_fluent, Fluents, Empty, State).

%!  fresh(+X, +Term, -X1, -Term1) is det.
%   Term1 is Term with variables of its own for those of X; all other variables stay shared.
fresh(X, Term, X1, Term1) :-
    term_variables(X, Own),
    term_variables(Term, All),
    exclude_variables(All, Own, Shared),
    copy_term(Shared-X-Term, Shared-X1-Term1).

exclude_variables([], _, []).
exclude_variables([V | Vs], Own, Shared) :-
    ( member(W, Own), W == V -> Shared = Rest ; Shared = [V | Rest] ),
    exclude_variables(Vs, Own, Rest).
