"""Work of every kind in one process for a long time: does it keep memory, files or threads?"""
