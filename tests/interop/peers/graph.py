"""The graph as rqt_graph gets it: rosgraph asks every node for its connections."""

import json

import rosgraph.impl.graph

graph = rosgraph.impl.graph.Graph()
graph.update()
edges = [[edge.start, edge.label, edge.end] for edge in graph.nn_edges]
print(json.dumps({"edges": edges, "unreachable": sorted(graph.bad_nodes)}))
