"""Functions of other libraries as they are: one file each, found by listing this folder.

What a user gets who calls them: nothing is turned, divided or left out, unlike in `peers`. A file
holds LABEL (the call), SOURCE (the library's documentation) and

    def values(vertices, faces):  # float64 (V, 3), int64 (F, 3), outward
        import library
        return {"K": library.gaussian(vertices, faces)}

with any of K, H, k1 (what the library calls the larger principal curvature) and k2, one value a
vertex. Further constants, all but the first optional:

`REQUIRES`    the distributions that it is imported from, separated by blanks; the first one's
              version is recorded
`INSTALL`     why `make peers` does not install them
`DOCUMENTED`  what the documentation says: name of a check -> its words
`REMEDIES`    what a user has to do, where it is not what others have to: name of a check -> words
"""
