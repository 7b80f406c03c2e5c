# SPDX-License-Identifier: MIT
"""The dearest way through a function's compiled code, loops bounded: no execution can cost more."""


class LongestPath:
    """cost(counts) -> cycles; loops: {function: [passes by address of the loop's head]}."""

    def __init__(self, code, library, loops, cost):
        self.code, self.library, self.loops, self.cost = code, library, loops, cost
        self.entry = {}
        for address in sorted(code):
            self.entry.setdefault(code[address].function, address)
        self.done = {}

    def function(self, name):
        """Dearest counts of one call, callees included."""
        if name not in self.done:
            self.done[name] = None  # a second request while this one runs is a recursion
            self.done[name] = self._function(name)
        if self.done[name] is None:
            raise ValueError(f"recursion through {name}")
        return self.done[name]

    def _called(self, i):
        """Counts of the call or jump i to another function and of all that it does there."""
        if i.target_name in self.library:
            return {i.target_name: 1}  # its price has call and return in it
        if i.target_name not in self.entry:
            raise ValueError(f"{i.target_name}() has no cost")
        if i.target != self.entry[i.target_name]:
            raise ValueError(f"call into the middle of {i.target_name}")
        return add({i.flow + i.memory: 1}, self.function(i.target_name))

    def _edges(self, i):
        """[(address or None for the end, counts)] after instruction i."""
        counts = dict(i.counts)
        leaves = i.flow in ("branch", "conditional") and (
            i.target_name != i.function or i.target == self.entry[i.function] and i.flow == "branch"
        )
        if i.flow == "return":
            return [(None, add(counts, {"return" + i.memory: 1}))]
        if i.flow == "call":
            return [(i.next.address, add(counts, self._called(i)))]
        if i.flow == "branch":
            if leaves:  # tail call: the callee returns for both
                return [(None, add(counts, self._called(i)))]
            return [(i.target, add(counts, {"branch" + i.memory: 1}))]
        if i.flow == "conditional":
            if leaves:
                raise ValueError(f"conditional tail call at {i.address:x}")
            ways = ((i.target, "taken"), (i.next.address, "not_taken"))
            return [
                (goal, add(counts, {} if i.free else {way + i.memory: 1})) for goal, way in ways
            ]
        return [(i.next.address, counts)] if i.next else []

    def _function(self, name):
        graph = {a: self._edges(i) for a, i in self.code.items() if i.function == name}
        start = self.entry[name]
        for head, body in loops_inside_out(graph, start):
            passes = self._passes(name, head, graph, start)
            collapse(graph, head, body, passes, self.cost)
        return dearest(graph, start, self.cost)[None]

    def _passes(self, name, head, graph, start):
        bounds = self.loops.get(name, [])
        heads = self.done.setdefault((name, "heads"), sorted(h for h, _ in all_loops(graph, start)))
        if len(heads) != len(bounds):
            raise ValueError(f"{name} has {len(heads)} loops, {len(bounds)} bounds are known")
        return bounds[heads.index(head)]


def add(*parts):
    total = {}
    for part in parts:
        for key, value in part.items():
            total[key] = total.get(key, 0) + value
    return total


def times(counts, factor):
    return {key: factor * value for key, value in counts.items()}


def all_loops(graph, start):
    """[(head, body)] of natural loops, found from the back edges of a depth-first search."""
    back, state, stack = {}, {start: 1}, [(start, iter(graph[start]))]
    while stack:
        node, edges = stack[-1]
        for target, _ in edges:
            if target is None or state.get(target) == 2:
                continue
            if state.get(target) == 1:
                back.setdefault(target, set()).add(node)
            else:
                state[target] = 1
                stack.append((target, iter(graph[target])))
                break
        else:
            state[node] = 2
            stack.pop()
    before = {}
    for node, edges in graph.items():
        for target, _ in edges:
            before.setdefault(target, set()).add(node)
    result = []
    for head, latches in back.items():
        body, todo = {head}, list(latches)
        while todo:
            node = todo.pop()
            if node not in body:
                body.add(node)
                todo += before.get(node, ())
        result.append((head, body))
    return result


def loops_inside_out(graph, start):
    """Yields the loops of the shrinking graph, inner before outer."""
    while True:
        found = all_loops(graph, start)
        if not found:
            return
        yield min(found, key=lambda loop: len(loop[1]))


def collapse(graph, head, body, passes, cost):
    """Replaces a loop by edges from its head to its exits: all passes, the last up to the exit."""
    inside = {node: [e for e in graph[node] if e[0] in body and e[0] != head] for node in body}
    ways = dearest(inside, head, cost)
    once = max(
        (
            add(ways[node], counts)
            for node in body
            for target, counts in graph[node]
            if target == head and node in ways
        ),
        key=cost,
    )
    exits = [
        (target, add(times(once, passes - 1), ways[node], counts))
        for node in body
        if node in ways
        for target, counts in graph[node]
        if target not in body
    ]
    for node in body - {head}:
        del graph[node]
    graph[head] = exits


def dearest(graph, start, cost):
    """{node: counts} of the dearest way from start to each node of an acyclic graph; None is the
    end."""
    order, seen = [], set()
    stack = [(start, False)]
    while stack:
        node, finished = stack.pop()
        if finished:
            order.append(node)
        elif node not in seen:
            seen.add(node)
            stack.append((node, True))
            stack += [(target, False) for target, _ in graph.get(node, ()) if target not in seen]
    best = {start: {}}
    for node in reversed(order):
        for target, counts in graph.get(node, ()):
            way = add(best[node], counts)
            if target not in best or cost(way) > cost(best[target]):
                best[target] = way
    return best
