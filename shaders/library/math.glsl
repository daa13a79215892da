// Elementary functions in both precisions.
